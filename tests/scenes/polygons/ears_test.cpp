#include "scenes/polygons/ears.h"

#include "tests/scenes/polygons/shapes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace {

using scenes::polygons::cut_ears;
using transport_test::PointTriangle;
using transport_test::Shape;
using transport_test::WholePoint;

std::int64_t area_of(const Shape& shape, const std::vector<PointTriangle>& triangles)
{
    std::int64_t area = 0;
    for (const auto& [a, b, c] : triangles) {
        const std::int64_t one = transport_test::twice_area(shape[0][a], shape[0][b], shape[0][c]);
        EXPECT_GE(one, 0);
        area += one;
    }
    return area;
}

RC_GTEST_PROP(CutEars, TrianglesOfASimplePolygonAllHaveAnArea, ())
{
    const Shape shape = {transport_test::any_simple_ring(30)};
    const auto triangles =
        cut_ears(transport_test::points_of(shape), transport_test::rings_of(shape)[0]);
    RC_ASSERT(triangles.has_value());
    RC_ASSERT(triangles->size() == shape[0].size() - 2);
    for (const auto& [a, b, c] : *triangles)
        RC_ASSERT(transport_test::twice_area(shape[0][a], shape[0][b], shape[0][c]) > 0);
}

TEST(CutEars, AConvexPolygonIsNotCutIntoAFan)
{
    Shape shape(1);
    for (std::int64_t x = 0; x < 64; ++x) shape[0].push_back({x, x * x});
    const auto triangles =
        cut_ears(transport_test::points_of(shape), transport_test::rings_of(shape)[0]);
    ASSERT_TRUE(triangles.has_value());
    std::vector<int> uses(64);
    for (const PointTriangle& triangle : *triangles)
        for (const std::uint32_t corner : triangle) ++uses[corner];
    EXPECT_LE(*std::max_element(uses.begin(), uses.end()),
              2 * 6); // halved six times, with two triangles each
}

// Both sides of a spike are outside, or both inside. If a spike is not removed first, the wrong side of
// it may be mistaken for an ear.
TEST(CutEars, SpikesGoFirst)
{
    const Shape shape = {{{0, 1}, {1, 0}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {1, 0}, {1, 1}}};
    const auto triangles =
        cut_ears(transport_test::points_of(shape), transport_test::rings_of(shape)[0]);
    ASSERT_TRUE(triangles.has_value());
    EXPECT_EQ(area_of(shape, *triangles), 2);
}

// The outline returns to its first corner from inside. If the ear is cut off there, it includes the way
// back.
TEST(CutEars, ACornerThatIsVisitedTwice)
{
    const Shape shape = {{{1, 2}, {1, 1}, {3, 0}, {3, 3}, {2, 1}, {1, 2}, {0, 2}, {0, 0}}};
    const auto triangles =
        cut_ears(transport_test::points_of(shape), transport_test::rings_of(shape)[0]);
    ASSERT_TRUE(triangles.has_value());
    EXPECT_EQ(area_of(shape, *triangles), transport_test::twice_area(shape));
}

TEST(CutEars, NothingButSpikes)
{
    Shape shape(1);
    for (int i = 0; i < 10000; ++i) shape[0].push_back({i % 2, 0});
    const auto triangles =
        cut_ears(transport_test::points_of(shape), transport_test::rings_of(shape)[0]);
    ASSERT_TRUE(triangles.has_value());
    EXPECT_EQ(area_of(shape, *triangles), 0);
}

TEST(CutEars, AClockwiseOutlineHasNone)
{
    const Shape shape = {{{0, 0}, {0, 2}, {2, 2}, {2, 0}}};
    EXPECT_FALSE(
        cut_ears(transport_test::points_of(shape), transport_test::rings_of(shape)[0]).has_value());
}

} // namespace
