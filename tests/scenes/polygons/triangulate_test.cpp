#include "scenes/polygons/triangulate.h"

#include "tests/scenes/polygons/shapes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

using scenes::Vec3;
using scenes::polygons::Corners;
using scenes::polygons::PolygonFaults;
using scenes::polygons::Polygons;
using transport_test::Shape;
using transport_test::WholePoint;

struct Result {
    std::vector<Corners> triangles;
    PolygonFaults faults;
};

/// One polygon of the rings of `shape`, its corners at `positions`.
Result triangulate(const Shape& shape, const std::vector<Vec3>& positions)
{
    Polygons polygons;
    for (const auto& ring : shape) polygons.sizes.push_back(static_cast<std::uint32_t>(ring.size()));
    polygons.corners.resize(positions.size());
    std::iota(polygons.corners.begin(), polygons.corners.end(), 0);
    polygons.rings = {static_cast<std::uint32_t>(shape.size())};
    Result result;
    triangulate(polygons, positions, result.triangles, result.faults);
    return result;
}

/// The plane of whole numbers, mapped into space without rounding.
struct Plane {
    Vec3 origin, u, v;
    [[nodiscard]] std::vector<Vec3> positions(const Shape& shape) const
    {
        std::vector<Vec3> result;
        for (const WholePoint& p : transport_test::all_corners(shape))
            result.push_back(origin + static_cast<double>(p.x) * u + static_cast<double>(p.y) * v);
        return result;
    }
    [[nodiscard]] Vec3 normal() const { return glm::cross(u, v); }
};

Plane any_plane()
{
    const auto vector = [] {
        const auto whole = [] { return static_cast<double>(*rc::gen::inRange(-9, 10)); };
        return Vec3(whole(), whole(), whole());
    };
    const Plane plane{1000.0 * vector(), vector(), vector()};
    RC_PRE(plane.normal() != Vec3(0.0));
    return plane;
}

Vec3 area_vector(const Corners& c)
{
    return glm::cross(c[1] - c[0], c[2] - c[0]);
}

RC_GTEST_PROP(Triangulate, APlanarPolygonInAnyPlaneIsCutExactly, ())
{
    const Shape shape = *rc::gen::arbitrary<bool>() ? transport_test::any_shape_with_holes(12, 3)
                                                    : Shape{transport_test::any_simple_ring(20)};
    const Plane plane = any_plane();
    const Result result = triangulate(shape, plane.positions(shape));
    RC_ASSERT(result.faults.non_planar == 0 && result.faults.crossed == 0);
    RC_ASSERT(result.triangles.size() ==
              transport_test::all_corners(shape).size() + 2 * shape.size() - 4);
    Vec3 sum(0.0);
    for (const Corners& triangle : result.triangles) {
        RC_ASSERT(glm::dot(area_vector(triangle), plane.normal()) >= 0);
        sum += area_vector(triangle);
    }
    RC_ASSERT(sum == static_cast<double>(transport_test::twice_area(shape)) *
                         plane.normal()); // all are whole numbers
}

RC_GTEST_PROP(Triangulate, ItFacesTheOtherWayWhenItsCornersAreReversed, ())
{
    Shape shape = {transport_test::any_simple_ring(20)};
    std::reverse(shape[0].begin(), shape[0].end());
    const Plane plane = any_plane();
    const Result result = triangulate(shape, plane.positions(shape));
    RC_ASSERT(result.faults.crossed == 0);
    for (const Corners& triangle : result.triangles)
        RC_ASSERT(glm::dot(area_vector(triangle), plane.normal()) <= 0);
}

// From the smallest numbers to the largest: without scaling, products would overflow or underflow.
RC_GTEST_PROP(Triangulate, TheSizeMakesNoDifference, ())
{
    const Shape shape = {transport_test::any_simple_ring(12)};
    const std::vector<Vec3> positions = any_plane().positions(shape);
    const int exponent = *rc::gen::inRange(-1000, 1000);
    std::vector<Vec3> scaled;
    for (const Vec3& p : positions)
        scaled.emplace_back(std::ldexp(p.x, exponent), std::ldexp(p.y, exponent),
                            std::ldexp(p.z, exponent));
    const Result one = triangulate(shape, positions);
    const Result other = triangulate(shape, scaled);
    RC_ASSERT(one.triangles.size() == other.triangles.size());
    for (std::size_t i = 0; i < one.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis)
                RC_ASSERT(std::ldexp(one.triangles[i][k][axis], exponent) ==
                          other.triangles[i][k][axis]);
}

RC_GTEST_PROP(Triangulate, AWarpedPolygonIsCutAsItsProjection, ())
{
    const Shape shape = {transport_test::any_simple_ring(20)};
    RC_PRE(shape[0].size() > 4U);
    const Plane plane = any_plane();
    const Vec3 normal = plane.normal();
    std::vector<Vec3> positions = plane.positions(shape);
    Vec3 sum(0.0);
    double size = 0;
    for (Vec3& position : positions) {
        position += 0.01 * static_cast<double>(*rc::gen::inRange(-50, 51)) * normal;
        size = std::max(size, glm::distance(position, positions[0]));
    }
    for (std::size_t i = 1; i + 1 < positions.size(); ++i)
        sum += area_vector({positions[0], positions[i], positions[i + 1]});
    const Result result = triangulate(shape, positions);
    // Heights tilt the mean plane, and the projection onto it may cross itself.
    RC_PRE(result.faults.crossed == 0U);
    RC_ASSERT(result.triangles.size() == positions.size() - 2);
    const double rounding = 1e-14 * size * size; // some 50 roundings
    Vec3 total(0.0);
    for (const Corners& triangle : result.triangles) {
        RC_ASSERT(glm::dot(area_vector(triangle), glm::normalize(sum)) >= -rounding);
        total += area_vector(triangle);
    }
    RC_ASSERT(glm::distance(total, sum) <= 20 * rounding);
}

TEST(Triangulate, AWarpedConcavePolygonIsCutWithoutLeavingIt)
{
    // A dart, concave at its third corner, with the tips bent up and down.
    const Shape dart = {{{4, 1}, {1, 1}, {1, 4}, {0, 0}}};
    const std::vector<Vec3> positions = {{4, 1, 0.5}, {1, 1, 0}, {1, 4, 0.5}, {0, 0, 0}};
    const Result result = triangulate(dart, positions);
    EXPECT_EQ(result.faults.non_planar, 1);
    EXPECT_EQ(result.faults.crossed, 0);
    ASSERT_EQ(result.triangles.size(), 2);
    for (const Corners& triangle : result.triangles) // both contain the concave corner
        EXPECT_EQ(std::count(triangle.begin(), triangle.end(), Vec3(1, 1, 0)), 1);
}

TEST(Triangulate, APolygonOfNoAreaIsAFanOfTrianglesOfNoArea)
{
    const Shape line = {{{0, 0}, {3, 3}, {1, 1}, {2, 2}}};
    const Result result = triangulate(line, {{0, 0, 0}, {3, 3, 3}, {1, 1, 1}, {2, 2, 2}});
    EXPECT_EQ(result.triangles.size(), 2);
    EXPECT_EQ(result.faults.zero_area, 2);
    EXPECT_EQ(result.faults.crossed, 0);
    const Result point = triangulate(line, std::vector<Vec3>(4, Vec3(7.0)));
    EXPECT_EQ(point.faults.zero_area, 2);
    const Result origin = triangulate(line, std::vector<Vec3>(4, Vec3(0.0)));
    EXPECT_EQ(origin.faults.zero_area, 2);
    // In line only up to rounding, since a tenth is not a double.
    const Result tenths =
        triangulate(line, {{0.1, 0.2, 0.3}, {0.2, 0.4, 0.6}, {0.3, 0.6, 0.9}, {0.7, 1.4, 2.1}});
    EXPECT_EQ(tenths.triangles.size(), 2);
    EXPECT_EQ(tenths.faults.crossed, 0);
}

TEST(Triangulate, ABowTieIsReportedAndCutAsAFan)
{
    for (const std::int64_t top : {4, 3}) { // areas that sum to zero, and areas that do not
        const Shape bow_tie = {{{0, 0}, {4, 4}, {4, 0}, {0, top}}};
        const std::vector<Vec3> positions =
            Plane{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)}.positions(bow_tie);
        const Result result = triangulate(bow_tie, positions);
        EXPECT_EQ(result.faults.crossed, 1);
        ASSERT_EQ(result.triangles.size(), 2);
        EXPECT_EQ(result.triangles[0], (Corners{positions[0], positions[1], positions[2]}));
        EXPECT_EQ(result.triangles[1], (Corners{positions[0], positions[2], positions[3]}));
    }
}

TEST(Triangulate, PolygonsAreTakenOneAfterTheOther)
{
    // A square with a hole, something too small with a hole of its own, a triangle, a square whose hole
    // is too small.
    const std::vector<Vec3> positions = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0},
                                         {2, 2, 0}, {2, 4, 0}, {4, 2, 0}};
    const Polygons polygons{{4, 3, 2, 3, 3, 4, 2},
                            {0, 1, 2, 3, 4, 5, 6, 0, 1, 4, 5, 6, 0, 1, 4, 3, 2, 1, 0, 4, 5},
                            {2, 2, 1, 2}};
    std::vector<Corners> triangles;
    PolygonFaults faults;
    triangulate(polygons, positions, triangles, faults);
    EXPECT_EQ(faults.too_small, 1);
    EXPECT_EQ(faults.small_holes, 1);
    ASSERT_EQ(triangles.size(), 7 + 1 + 2);
    EXPECT_EQ(triangles[7], (Corners{positions[0], positions[1], positions[4]}));
    EXPECT_EQ(triangles[8], (Corners{positions[3], positions[2], positions[1]}));
    double area = 0;
    for (std::size_t i = 0; i < 7; ++i) area += area_vector(triangles[i]).z / 2;
    EXPECT_EQ(area, 81 - 2);
}

TEST(Triangulate, VeryManyCornersAreRefusedUnlessConvex)
{
    const Shape large = {transport_test::star(20000)};
    const Plane plane{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    const Result star = triangulate(large, plane.positions(large));
    EXPECT_EQ(star.faults.too_large, 1);
    EXPECT_TRUE(star.triangles.empty());
    Shape convex(1);
    for (std::int64_t x = 0; x < 40000; ++x) convex[0].push_back({x, x * x});
    const Result parabola = triangulate(convex, plane.positions(convex));
    EXPECT_EQ(parabola.faults.too_large, 0);
    EXPECT_EQ(parabola.triangles.size(), 39998);
}

} // namespace
