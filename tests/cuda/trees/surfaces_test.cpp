// Triangles and spheres together: queries with a tree compared with those without one, bit for bit,
// and with double precision.

#include "cuda/trees/surfaces.h"

#include "cuda/parallel/threaded_executor.h"
#include "cuda/trees/scene_geometry.h"
#include "tests/cuda/trees/float_limits.h"
#include "tests/cuda/trees/hit_bounds.h"
#include "tests/cuda/trees/triangles.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <type_traits>
#include <utility>

namespace {

using fast::Hit;
using fast::Ray;
using fast::Sphere;
using fast::SurfaceTree;
using fast::Triangle;
using fast::Vec3;
using fast_trees_test::infinity;
using trees_test::Random;

static_assert(std::is_trivially_copyable_v<fast::Surfaces<false>>);
static_assert(std::is_trivially_copyable_v<fast::Surfaces<true>>);

struct Shapes {
    std::vector<Triangle> triangles;
    std::vector<Sphere> spheres;
};

/// Shapes on a lattice, which makes ties, or anywhere; some coincide with others.
Shapes some_shapes(std::size_t triangles, std::size_t spheres, Random& random)
{
    const bool lattice = random.below(2) == 0;
    const double scale = random.magnitude(-6, 6);
    const auto place = [&] {
        return lattice ? glm::round(Vec3(4.0 * random.in_cube())) : Vec3(scale * random.in_cube());
    };
    Shapes shapes;
    for (std::size_t i = 0; i < triangles; ++i)
        shapes.triangles.push_back(i > 0 && random.below(8) == 0
                                       ? shapes.triangles[random.below(i)]
                                       : Triangle{{place(), place(), place()}});
    for (std::size_t i = 0; i < spheres; ++i) {
        const auto radius = static_cast<float>(lattice ? 1.0 + static_cast<double>(random.below(4))
                                                       : scale * random.magnitude(-4, 0.5));
        shapes.spheres.push_back(i > 0 && random.below(8) == 0 ? shapes.spheres[random.below(i)]
                                                               : Sphere{place(), radius});
    }
    return shapes;
}

/// A ray from a vertex, a sphere or anywhere to another such place, or along an axis.
Ray some_ray(const Shapes& shapes, Random& random)
{
    const auto place = [&] {
        if (!shapes.triangles.empty() && random.below(2) == 0)
            return shapes.triangles[random.below(shapes.triangles.size())].vertices[random.below(3)];
        if (!shapes.spheres.empty() && random.below(4) != 0) {
            const Sphere& sphere = shapes.spheres[random.below(shapes.spheres.size())];
            return sphere.center + sphere.radius * Vec3(random.direction());
        }
        const float far = shapes.triangles.empty() ? 8 : glm::length(shapes.triangles[0].vertices[0]);
        return far * Vec3(random.in_cube());
    };
    Ray ray{place(), random.below(2) == 0 ? infinity : 1.0f, Vec3(0)};
    ray.direction = place() - ray.origin;
    if (random.below(4) == 0) {
        ray.direction = Vec3(0);
        ray.direction[static_cast<int>(random.below(3))] = random.below(2) == 0 ? 1.0f : -1.0f;
    }
    return ray;
}

/// The closest hit without a tree.
Hit linear_search_of(const Shapes& shapes, const Ray& ray)
{
    Hit best = fast_trees_test::linear_search(shapes.triangles, ray);
    for (std::size_t i = 0; i < shapes.spheres.size(); ++i) {
        Hit hit{0, static_cast<std::uint32_t>(shapes.triangles.size() + i), 0, 0};
        if (intersect_sphere(ray, shapes.spheres[i], ray.t_max, hit) && hit.t < best.t) best = hit;
    }
    return best;
}

bool same_bits(const Hit& a, const Hit& b)
{
    using Words = std::array<std::uint32_t, 4>;
    return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

template <bool has_spheres>
bool finds(const fast::Surfaces<has_spheres>& surfaces, const Ray& ray, const Hit& expected)
{
    return same_bits(intersect(surfaces, ray), expected) &&
           occluded(surfaces, ray) == (expected.primitive != fast::no_primitive);
}

RC_GTEST_PROP(Surfaces, AreHitWhereTheLinearSearchHitsThem, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const Shapes shapes = some_shapes(*rc::gen::inRange<std::size_t>(0, 100),
                                      *rc::gen::inRange<std::size_t>(0, 20), random);
    fast::HostMemory memory;
    fast::SerialExecutor serial;
    fast::ThreadedExecutor threads(3, 1);
    const fast::TreeBuilder builder = *rc::gen::elementOf(fast::tree_builders);
    const SurfaceTree tree(memory, serial, shapes.triangles, shapes.spheres, builder);
    const SurfaceTree same(memory, threads, shapes.triangles, shapes.spheres, builder);
    RC_ASSERT(tree.has_spheres() == !shapes.spheres.empty());
    for (int i = 0; i < 50; ++i) {
        const Ray ray = some_ray(shapes, random);
        const Hit expected = linear_search_of(shapes, ray);
        RC_ASSERT(finds(tree.view<true>(), ray, expected));
        RC_ASSERT(finds(same.view<true>(), ray, expected));
        if (!tree.has_spheres()) RC_ASSERT(finds(tree.view<false>(), ray, expected));
    }
}

RC_GTEST_PROP(Surfaces, AreHitWhereDoublePrecisionHitsThemWithinTheDerivedBounds, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const Shapes shapes = some_shapes(20, 10, random);
    fast::HostMemory memory;
    fast::SerialExecutor serial;
    const SurfaceTree tree(memory, serial, shapes.triangles, shapes.spheres);
    for (int i = 0; i < 50; ++i) {
        const Ray ray = some_ray(shapes, random);
        if (ray.direction == Vec3(0)) continue;
        std::vector<fast_trees_test::HitBounds> bounds;
        for (const Triangle& triangle : shapes.triangles)
            bounds.push_back(fast_trees_test::hit_bounds(ray, triangle));
        for (const Sphere& sphere : shapes.spheres)
            bounds.push_back(fast_trees_test::hit_bounds(ray, sphere));
        const Hit hit = intersect(tree.view<true>(), ray);
        for (const fast_trees_test::HitBounds& one : bounds)
            RC_ASSERT(!one.certain || hit.t <= one.highest);
        if (hit.primitive == fast::no_primitive) continue;
        RC_ASSERT(bounds[hit.primitive].possible);
        RC_ASSERT(bounds[hit.primitive].lowest <= hit.t && hit.t <= bounds[hit.primitive].highest);
    }
}

TEST(Surfaces, OneOrNoneNeedsNoTree)
{
    fast::HostMemory memory;
    fast::SerialExecutor serial;
    const Ray ray{Vec3(0), infinity, Vec3(0, 0, 1)};
    const SurfaceTree none(memory, serial, {}, {});
    EXPECT_EQ(intersect(none.view<true>(), ray).primitive, fast::no_primitive);
    EXPECT_FALSE(occluded(none.view<false>(), ray));
    EXPECT_EQ(none.diagonal(), 0);
    const std::vector<Sphere> ball = {{Vec3(0, 0, 3), 1}};
    const SurfaceTree one(memory, serial, {}, ball);
    EXPECT_EQ(intersect(one.view<true>(), ray).primitive, 0);
    EXPECT_EQ(intersect(one.view<true>(), ray).t, 2);
    EXPECT_TRUE(occluded(one.view<true>(), ray));
    EXPECT_FALSE(occluded(one.view<true>(), {Vec3(0), 2, Vec3(0, 0, 1)}));
    EXPECT_NEAR(one.diagonal(), std::sqrt(12.0), 1e-5);
}

/// Triangles in boxes that are nested in each other, in the order of their centroids on the curve of 63
/// bits: 16 have the same centroid, and each next centroid differs from the first in one bit more. So
/// the radix tree is as deep as it can be, and on each of its levels clusters are merged one by one.
std::vector<Triangle> nested_triangles()
{
    std::vector<Triangle> triangles;
    const auto add = [&](const Vec3& centre, float extent) {
        triangles.push_back(
            {{centre - extent, centre + Vec3(-extent, extent, extent), centre + extent}});
    };
    for (int bit = 0; bit <= 63; ++bit)
        for (int i = 0; i < 16; ++i) {
            Vec3 centre(0);
            if (bit < 63) centre[bit % 3] = std::ldexp(1.0f, -1 - bit / 3);
            add(centre, 1 + static_cast<float>(63 - bit) / 64 + static_cast<float>(i) / 2048);
        }
    add(Vec3(1), 2.5f);
    return triangles;
}

TEST(Surfaces, WhoseClusteredTreeIsTooDeepHaveTheRadixTree)
{
    using enum fast::TreeBuilder;
    const Shapes nested{nested_triangles(), {}};
    fast::HostMemory memory;
    fast::SerialExecutor serial;
    Random random(1);
    for (const auto& [asked, given] :
         {std::pair{hploc63, morton63}, std::pair{hploc30, hploc30}, std::pair{morton63, morton63}}) {
        const SurfaceTree tree(memory, serial, nested.triangles, {}, asked);
        EXPECT_EQ(tree.builder(), given);
        for (int i = 0; i < 20; ++i) {
            const Ray ray = some_ray(nested, random);
            EXPECT_TRUE(finds(tree.view<false>(), ray, linear_search_of(nested, ray)));
        }
    }
}

TEST(Surfaces, ThatAreAskedByNoRayAnswerThatNothingIsHit)
{
    fast::HostMemory memory;
    fast::SerialExecutor serial;
    const trees_test::Mesh mesh = trees_test::icosphere(2, 1);
    const SurfaceTree tree(memory, serial, fast_trees_test::triangles_of(mesh), {{{Vec3(0), 0.5f}}});
    const Vec3 inside(0.1f, 0.2f, 0.7f);
    const Vec3 up(0, 0, 1);
    ASSERT_TRUE(occluded(tree.view<true>(), {inside, infinity, up}));
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            Ray nowhere{inside, infinity, up};
            nowhere.origin[axis] = bad;
            Ray aimless{inside, infinity, up};
            aimless.direction[axis] = bad;
            for (const Ray& ray : {nowhere, aimless, Ray{inside, infinity, Vec3(0)}}) {
                EXPECT_EQ(intersect(tree.view<true>(), ray).primitive, fast::no_primitive);
                EXPECT_FALSE(occluded(tree.view<true>(), ray));
            }
        }
}

std::string complaint(const Shapes& shapes)
{
    fast::HostMemory memory;
    fast::SerialExecutor serial;
    try {
        const SurfaceTree tree(memory, serial, shapes.triangles, shapes.spheres);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "none";
}

TEST(Surfaces, ThatAreNotFiniteAreRejectedByTheirNumber)
{
    const Triangle fine{{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)}};
    Triangle bad = fine;
    bad.vertices[1].y = std::numeric_limits<float>::quiet_NaN();
    const std::string not_finite = ": a coordinate of its box is NaN or infinite";
    EXPECT_EQ(complaint({{fine, bad}, {}}), "primitive 1" + not_finite);
    EXPECT_EQ(complaint({{fine}, {{Vec3(0), 1}, {Vec3(0, infinity, 0), 1}}}),
              "primitive 2" + not_finite);
    EXPECT_EQ(complaint({{fine}, {{Vec3(0), infinity}}}), "primitive 1" + not_finite);
    EXPECT_EQ(complaint({{}, {{Vec3(0), -1}}}), "primitive 0: its box is empty");
    EXPECT_EQ(complaint({{fine}, {{Vec3(0), 0}}}), "none");
}

// Rejected before any of them is read: primitive numbers have 32 bits.
TEST(Surfaces, ThatAreTooManyAreRefused)
{
    fast::HostMemory memory;
    fast::SerialExecutor serial;
    const Triangle triangle{{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)}};
    const Sphere sphere{Vec3(0), 1};
    const auto refusal = [&](std::size_t triangles, std::size_t spheres) -> std::string {
        try {
            const SurfaceTree tree(memory, serial, {&triangle, triangles}, {&sphere, spheres});
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(refusal(1, 1), "");
    const std::string most = "a tree may have 536870912 primitives, not ";
    EXPECT_EQ(refusal((std::size_t{1} << 32) + 1, 0), most + "4294967297 triangles and 0 spheres");
    EXPECT_EQ(refusal(1, fast::most_primitives), most + "1 triangles and 536870912 spheres");
    EXPECT_EQ(refusal(1, std::size_t{1} << 32), most + "1 triangles and 4294967296 spheres");
}

TEST(SceneGeometry, FarFromTheOriginLosesNothingIfTheOriginIsNear)
{
    Random random(1);
    const ref::Vec3 far(1e9, -3e8, 7e9); // where neighbouring floats differ by 64 or more
    const trees_test::Mesh mesh = trees_test::icosphere(1, 1);
    scenes::Scene near_scene = scene_of(mesh);
    near_scene.spheres = {{ref::Vec3(0.25, 0.5, -1), 0.75, 0}};
    scenes::Scene far_scene = scene_of(moved(mesh, 1, far));
    far_scene.spheres = {{near_scene.spheres[0].center + far, 0.75, 0}};
    const auto triangles = fast::triangles_of(far_scene, {far});
    const auto spheres = fast::spheres_of(far_scene, {far});
    const auto boxes = fast::boxes_of(far_scene, {far});
    ASSERT_EQ(triangles.size(), near_scene.triangles.size());
    ASSERT_EQ(boxes.size(), scenes::primitive_count(near_scene));
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            // The doubles of the far scene have an error of half of 2^-20.
            EXPECT_LE(
                glm::length(ref::Vec3(triangles[i].vertices[k]) - near_scene.triangles[i].vertices[k]),
                0x1p-20);
    EXPECT_EQ(spheres[0].center, Vec3(0.25, 0.5, -1));
    EXPECT_EQ(spheres[0].radius, 0.75f);
    EXPECT_LE(boxes.back().lower.x, -0.5f);
    EXPECT_GE(boxes.back().upper.z, -0.25f);
}

} // namespace
