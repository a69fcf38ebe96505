#include "scenes/polygons/crossings.h"

#include "tests/scenes/polygons/shapes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

namespace {

using transport_test::Shape;
using transport_test::WholePoint;

bool cross(const Shape& shape)
{
    return scenes::polygons::cross(transport_test::points_of(shape), transport_test::rings_of(shape));
}

RC_GTEST_PROP(Crossings, SimplePolygonsHaveNone, ())
{
    RC_ASSERT(!cross({transport_test::any_simple_ring(30)}));
}

// Two edges that are not in line cross if they have a point in common that is a corner of neither.
RC_GTEST_PROP(Crossings, AreSeenWhereverTheyAre, ())
{
    std::vector<WholePoint> ring;
    const int corners = *rc::gen::inRange(4, 20);
    for (int i = 0; i < corners; ++i)
        ring.push_back({*rc::gen::inRange(0, 1000), *rc::gen::inRange(0, 1000)});
    const std::size_t n = ring.size();
    bool expected = false;
    bool touch = false;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) {
            const WholePoint& a = ring[i];
            const WholePoint& b = ring[(i + 1) % n];
            const WholePoint& c = ring[j];
            const WholePoint& d = ring[(j + 1) % n];
            const auto abc = transport_test::twice_area(a, b, c);
            const auto abd = transport_test::twice_area(a, b, d);
            const auto cda = transport_test::twice_area(c, d, a);
            const auto cdb = transport_test::twice_area(c, d, b);
            const bool on_a_line = abc == 0 || abd == 0 || cda == 0 || cdb == 0;
            touch = touch || (j > i + 1 && (j + 1) % n != i && on_a_line);
            expected = expected || (!on_a_line && (abc < 0) != (abd < 0) && (cda < 0) != (cdb < 0));
        }
    RC_PRE(!touch);
    RC_ASSERT(cross({ring}) == expected);
}

TEST(Crossings, ToTouchIsNotToCross)
{
    EXPECT_FALSE(cross({{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}})); // a corner on an edge
    EXPECT_FALSE(
        cross({{{0, 0}, {2, 0}, {2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}, {0, 2}}})); // two corners
    EXPECT_FALSE(
        cross({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{0, 2}, {0, 5}, {3, 4}}})); // an edge on an edge
    EXPECT_FALSE(cross({{{0, 0}, {0, 0}, {2, 0}, {2, 0}, {0, 2}, {0, 0}}}));  // repeated corners
    EXPECT_FALSE(
        cross({{{0, 9}, {0, 5}, {0, 6}, {0, 3}, {0, 5}, {0, 4}, {0, 5}, {0, 0}, {9, 0}}})); // spikes
}

TEST(Crossings, ThroughACornerTheyCount)
{
    EXPECT_TRUE(cross({{{0, 0}, {4, 4}, {4, 0}, {2, 2}, {0, 4}}})); // through an edge at a corner
    EXPECT_TRUE(cross({{{0, 0}, {2, 2}, {4, 4}, {4, 0}, {2, 2}, {0, 4}}})); // through a corner
    EXPECT_TRUE(
        cross({{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{4, 1}, {8, 2}, {4, 3}, {2, 2}}})); // another ring
}

} // namespace
