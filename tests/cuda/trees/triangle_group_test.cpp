// Four triangles at once: no triangle that is hit may be skipped.

#include "cuda/trees/triangle_group.h"

#include "tests/cuda/trees/float_limits.h"
#include "tests/ref/trees/meshes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <limits>

namespace {

using fast::Ray;
using fast::Triangle;
using fast::TriangleGroup;
using fast::Vec3;
using fast_trees_test::infinity;
using trees_test::Random;

TriangleGroup group_of(const std::vector<Triangle>& triangles)
{
    TriangleGroup group{};
    for (int lane = 0; lane < fast::lane_count; ++lane) {
        const auto i = static_cast<std::size_t>(lane);
        const bool there = i < triangles.size();
        group.primitives[i] = there ? static_cast<std::uint32_t>(lane) : fast::no_primitive;
        for (int k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis)
                group.vertices[k][axis][lane] =
                    there ? triangles[i].vertices[k][axis] : std::numeric_limits<float>::quiet_NaN();
    }
    return group;
}

/// A ray from a point in the triangle's plane, up to a few roundings, and often nearly along that
/// plane. There it is hardest to decide whether the triangle is behind.
Ray barely_leaving(const Triangle& triangle, Random& random)
{
    const auto& v = triangle.vertices;
    const trees_test::Vec3 b = random.barycentric();
    const trees_test::Vec3 on(static_cast<float>(b[0]) * v[0] + static_cast<float>(b[1]) * v[1] +
                              static_cast<float>(b[2]) * v[2]);
    const trees_test::Vec3 e1(v[1] - v[0]);
    const trees_test::Vec3 e2(v[2] - v[0]);
    const trees_test::Vec3 normal = glm::normalize(glm::cross(e1, e2));
    const trees_test::Vec3 along =
        glm::normalize(random.uniform(-1, 1) * e1 + random.uniform(-1, 1) * e2);
    const double off = glm::length(e1) * random.magnitude(-9, -5);
    return {Vec3(on + off * random.direction()), infinity,
            Vec3(along + random.magnitude(-3, 1) * random.uniform(-1, 1) * normal)};
}

RC_GTEST_PROP(TriangleGroup, PassesOverNothingThatIsHit, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    for (int i = 0; i < 200; ++i) {
        const double scale = random.magnitude(-10, 10);
        const trees_test::Vec3 where =
            (random.below(2) == 0 ? 0.0 : random.magnitude(0, 3)) * random.direction();
        std::vector<Triangle> triangles(1 + random.below(fast::most_in_group));
        for (Triangle& triangle : triangles)
            for (Vec3& vertex : triangle.vertices) vertex = Vec3(scale * (where + random.in_cube()));
        const TriangleGroup group = group_of(triangles);
        for (int k = 0; k < 8; ++k) {
            const fast::ShearedRay ray(barely_leaving(triangles[0], random));
            const std::uint32_t candidates = may_hit(ray, group);
            RC_ASSERT(candidates < 1u << triangles.size()); // NaN is never a candidate
            for (std::size_t lane = 0; lane < triangles.size(); ++lane) {
                fast::Hit hit{};
                if (intersect_triangle(ray, triangles[lane], infinity, hit))
                    RC_ASSERT((candidates >> lane & 1) == 1u);
            }
        }
    }
}

TEST(TriangleGroup, LeavesOutWhatIsClearlyBehindOrBeside)
{
    Random random(1);
    int candidates = 0;
    int hits = 0;
    for (int i = 0; i < 10000; ++i) {
        std::vector<Triangle> triangles(fast::most_in_group);
        for (Triangle& triangle : triangles)
            for (Vec3& vertex : triangle.vertices) vertex = Vec3(random.in_cube());
        const TriangleGroup group = group_of(triangles);
        const fast::ShearedRay ray({Vec3(random.in_cube()), infinity, Vec3(random.direction())});
        for (std::uint32_t bits = may_hit(ray, group); bits != 0; bits &= bits - 1) ++candidates;
        intersect_group(ray, group, infinity, [&](const fast::Hit& /*hit*/) { ++hits; });
    }
    EXPECT_GT(hits, 500);
    EXPECT_LE(candidates, hits + 5); // 16 u is small compared with a random distance
}

} // namespace
