#include "tests/scenes/polygons/shapes.h"

#include "scenes/polygons/cut.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>
#include <string>

namespace {

using transport_test::PointTriangle;
using transport_test::Shape;
using transport_test::WholePoint;

std::optional<std::vector<PointTriangle>> cut(const Shape& shape)
{
    return scenes::polygons::cut_polygon(transport_test::points_of(shape),
                                         transport_test::rings_of(shape));
}

/// The fault of the triangles of a polygon; empty if there is none. Computed without rounding.
std::string faults(const Shape& shape, const std::optional<std::vector<PointTriangle>>& triangles)
{
    if (!triangles) return "not cut";
    const std::vector<WholePoint> corners = transport_test::all_corners(shape);
    const std::size_t holes = shape.size() - 1;
    if (triangles->size() != corners.size() + 2 * holes - 2)
        return std::to_string(triangles->size()) + " triangles";
    std::int64_t area = 0;
    std::set<std::uint32_t> used;
    for (const auto& [a, b, c] : *triangles) {
        const std::int64_t one = transport_test::twice_area(corners[a], corners[b], corners[c]);
        if (one < 0) return "a triangle is clockwise";
        area += one;
        used.insert({a, b, c});
    }
    if (used.size() != corners.size()) return "a corner is not used";
    if (area != transport_test::twice_area(shape)) return "the areas do not add up";
    return "";
}

/// Whether random points are in exactly one triangle if they are in the polygon, and otherwise in none.
/// Their coordinates are thirds of whole numbers; points on an edge are left out.
bool covers_once(const Shape& shape, const std::vector<PointTriangle>& triangles)
{
    const std::vector<WholePoint> corners = transport_test::all_corners(shape);
    const auto tripled = [&](std::uint32_t i) { return WholePoint{3 * corners[i].x, 3 * corners[i].y}; };
    for (int i = 0; i < 20; ++i) {
        // Near the corners, where mistakes are most likely.
        const auto near =
            static_cast<std::uint32_t>(*rc::gen::inRange(0, static_cast<int>(corners.size())));
        const WholePoint p{tripled(near).x + *rc::gen::inRange(-40, 40),
                           tripled(near).y + *rc::gen::inRange(-40, 40)};
        int in = 0;
        bool on_edge = false;
        for (const auto& [a, b, c] : triangles) {
            const std::int64_t ab = transport_test::twice_area(tripled(a), tripled(b), p);
            const std::int64_t bc = transport_test::twice_area(tripled(b), tripled(c), p);
            const std::int64_t ca = transport_test::twice_area(tripled(c), tripled(a), p);
            if (ab > 0 && bc > 0 && ca > 0) ++in;
            on_edge = on_edge || (ab >= 0 && bc >= 0 && ca >= 0 && (ab == 0 || bc == 0 || ca == 0));
        }
        if (!on_edge && in != (transport_test::is_inside(shape, p) ? 1 : 0)) return false;
    }
    return true;
}

RC_GTEST_PROP(CutPolygon, SimplePolygonsAreCoveredOnceByTrianglesThatDoNotTurnOver, ())
{
    const Shape shape = {transport_test::any_simple_ring(30)};
    RC_LOG(transport_test::text_of(shape));
    const auto triangles = cut(shape);
    RC_ASSERT(faults(shape, triangles) == "");
    RC_ASSERT(covers_once(shape, *triangles));
}

RC_GTEST_PROP(CutPolygon, WithHolesItIsTheSame, ())
{
    const Shape shape = transport_test::any_shape_with_holes(20, 5);
    RC_LOG(transport_test::text_of(shape));
    const auto triangles = cut(shape);
    RC_ASSERT(faults(shape, triangles) == "");
    RC_ASSERT(covers_once(shape, *triangles));
}

// Corners given twice or more, and spikes, have no area, and neither have their triangles.
RC_GTEST_PROP(CutPolygon, RepeatedCornersAndSpikesDoNoHarm, ())
{
    Shape shape = {transport_test::any_simple_ring(15)};
    for (WholePoint& p : shape[0]) p = {2 * p.x, 2 * p.y};
    const int additions = *rc::gen::inRange(1, 6);
    for (int i = 0; i < additions; ++i) {
        auto& ring = shape[0];
        const std::size_t at = *rc::gen::inRange<std::size_t>(0, ring.size());
        const WholePoint corner = ring[at];
        const WholePoint next = ring[(at + 1) % ring.size()];
        const auto place = ring.begin() + static_cast<std::ptrdiff_t>(at) + 1;
        if (*rc::gen::arbitrary<bool>())
            ring.insert(place, corner);
        else if ((corner.x + next.x) % 2 == 0 &&
                 (corner.y + next.y) % 2 == 0) // half of the edge and back
            ring.insert(place, {{(corner.x + next.x) / 2, (corner.y + next.y) / 2}, corner});
    }
    RC_LOG(transport_test::text_of(shape));
    RC_ASSERT(faults(shape, cut(shape)) == "");
}

RC_GTEST_PROP(CutPolygon, AConvexPolygonIsAFanAroundItsFirstCorner, ())
{
    // Points on a parabola, and some in line with their neighbours.
    std::vector<WholePoint> ring;
    const std::int64_t n = *rc::gen::inRange(3, 30);
    for (std::int64_t x = 0; x < n; ++x) {
        ring.push_back({2 * x, 4 * x * x});
        if (x + 1 < n && *rc::gen::arbitrary<bool>())
            ring.push_back({2 * x + 1, 2 * (x * x + (x + 1) * (x + 1))});
    }
    const auto first = *rc::gen::inRange<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(ring.size()));
    std::rotate(ring.begin(), ring.begin() + first, ring.end());
    const auto triangles = cut({ring});
    RC_ASSERT(triangles.has_value());
    for (std::uint32_t i = 0; i + 2 < ring.size(); ++i)
        RC_ASSERT(triangles->at(i) == (PointTriangle{0, i + 1, i + 2}));
}

TEST(CutPolygon, StarsSpiralsAndCombs)
{
    for (const int n : {3, 4, 5, 20, 300}) {
        for (const Shape& shape : {Shape{transport_test::star(n)}, Shape{transport_test::spiral(n)},
                                   Shape{transport_test::comb(n)}}) {
            ASSERT_TRUE(n > 20 || transport_test::is_simple(shape[0])) << n;
            Shape turned = shape; // with any corner as the first
            for (std::size_t i = 0; i<shape[0].size(); i += n> 20 ? 97 : 1) {
                std::rotate(turned[0].begin(), turned[0].begin() + 1, turned[0].end());
                EXPECT_EQ(faults(turned, cut(turned)), "");
            }
        }
    }
}

TEST(CutPolygon, OutlinesMayTouchThemselves)
{
    // Two squares that share a corner, in one walk; a square with another one inside, reached by a
    // bridge that is walked twice; the same square touching the outline with one corner and with an
    // edge.
    for (const Shape& shape :
         {Shape{{{0, 0}, {2, 0}, {2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}, {0, 2}}},
          Shape{{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}}},
          Shape{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{0, 3}, {3, 6}, {6, 3}}},
          Shape{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{0, 0}, {3, 6}, {6, 3}}},
          Shape{{{0, 0}, {9, 0}, {9, 9}, {0, 9}},
                {{2, 2}, {4, 2}, {4, 4}, {2, 4}},
                {{4, 4}, {6, 4}, {6, 6}, {4, 6}}}})
        EXPECT_EQ(faults(shape, cut(shape)), "");
}

TEST(CutPolygon, OutlinesThatCrossAreNotCut)
{
    const std::vector<WholePoint> square = {{0, 0}, {9, 0}, {9, 9}, {0, 9}};
    EXPECT_FALSE(cut({{{0, 0}, {4, 4}, {4, 0}, {0, 3}}}));                 // a bow tie
    EXPECT_FALSE(cut({{{0, 0}, {2, 2}, {4, 4}, {4, 0}, {2, 2}, {0, 3}}})); // corners where it crosses
    EXPECT_FALSE(cut({{{3, 0}, {-2, 2}, {1, -3}, {1, 3}, {-2, -2}}}));     // a pentagram
    EXPECT_FALSE(cut({{{0, 0}, {6, 0}, {6, 6}, {1, 6}, {1, -2}, {3, -2}, {3, 3}, {0, 3}}})); // a loop
    EXPECT_FALSE(cut({{{0, 0}, {0, 9}, {9, 9}, {9, 0}}}));                                   // clockwise
    EXPECT_FALSE(cut({square, {{5, 5}, {15, 5}, {5, 6}}}));      // a hole across the edge
    EXPECT_FALSE(cut({square, {{10, 10}, {12, 10}, {10, 12}}})); // a hole outside
    EXPECT_FALSE(
        cut({square, {{1, 1}, {5, 1}, {1, 5}}, {{2, 2}, {6, 2}, {2, 6}}})); // holes across holes
}

TEST(CutPolygon, AHoleOfFewerThanThreeDifferentCornersIsLeftOut)
{
    const auto triangles = cut({{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{2, 2}, {3, 3}, {2, 2}}});
    ASSERT_TRUE(triangles.has_value());
    EXPECT_EQ(triangles->size(), 2);
}

} // namespace
