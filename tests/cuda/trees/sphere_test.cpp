// A ray against one sphere in single precision, and the boxes of spheres.

#include "cuda/trees/sphere.h"

#include "cuda/parallel/executor.h"
#include "tests/cuda/trees/float_limits.h"
#include "tests/cuda/trees/hit_bounds.h"
#include "tests/ref/trees/meshes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace {

using fast::Hit;
using fast::Ray;
using fast::Sphere;
using fast::Vec3;
using fast_trees_test::HitBounds;
using fast_trees_test::infinity;
using trees_test::Random;

/// A sphere of any size, near or far, and a ray whose line hits it in the middle, hits it only just,
/// or only just misses it.
struct Encounter {
    Sphere sphere;
    Ray ray;
};

Encounter some_encounter(Random& random)
{
    const double scale = random.magnitude(-4, 10); // squares of the smallest lengths do not underflow
    const Sphere sphere{Vec3(scale * random.magnitude(-1, 2) * random.direction()),
                        static_cast<float>(scale * random.magnitude(-4, 1))};
    const auto near_surface = [&] {
        const double off = random.below(2) == 0 ? random.uniform() : random.magnitude(-8, 4);
        const double height = random.below(2) == 0 ? 1 + off : 1 - std::min(off, 1.0);
        return Vec3(ref::Vec3(sphere.center) + sphere.radius * height * random.direction());
    };
    Ray ray{near_surface(), infinity, Vec3(0)};
    if (random.below(3) == 0) ray.origin = Vec3(scale * random.magnitude(-1, 2) * random.direction());
    ray.direction = static_cast<float>(random.magnitude(-3, 3)) * (near_surface() - ray.origin);
    if (random.below(4) == 0) ray.t_max = static_cast<float>(random.magnitude(-3, 3));
    return {sphere, ray};
}

// map: sphere-discriminant, sphere-distance
RC_GTEST_PROP(IntersectSphereInFloat, FindsWhatIsThereWithinTheDerivedBound, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    for (int i = 0; i < 100; ++i) {
        const auto [sphere, ray] = some_encounter(random);
        if (ray.direction == Vec3(0)) continue;
        const HitBounds bounds = fast_trees_test::hit_bounds(ray, sphere);
        Hit hit{};
        const bool found = intersect_sphere(ray, sphere, ray.t_max, hit);
        RC_ASSERT(found || !bounds.certain);
        if (!found) continue;
        RC_ASSERT(bounds.possible);
        RC_ASSERT(bounds.lowest <= hit.t && hit.t <= bounds.highest);
        RC_ASSERT(hit.b1 == 0 && hit.b2 == 0);
    }
}

TEST(IntersectSphereInFloat, AgreesWithTheReferenceOnMostRays) // else the property above is empty
{
    Random random(1);
    int same = 0;
    int certain = 0;
    constexpr int rays = 20000;
    for (int i = 0; i < rays; ++i) {
        const auto [sphere, ray] = some_encounter(random);
        const auto expected = ref::intersect_sphere(fast_trees_test::exactly(ray),
                                                    ref::Vec3(sphere.center), sphere.radius);
        Hit hit{};
        const bool found = intersect_sphere(ray, sphere, ray.t_max, hit);
        same += found == expected.has_value() ? 1 : 0;
        certain += fast_trees_test::hit_bounds(ray, sphere).certain ? 1 : 0;
    }
    EXPECT_GT(same, rays * 95 / 100);
    EXPECT_GT(certain, rays / 4);
}

TEST(IntersectSphereInFloat, ADistantSphereIsMetAsPreciselyAsItCanBe)
{
    // r^2 - |l|^2 is 1 here; b^2 - a c would be the difference of two numbers of 1e8 that differ by 1.
    Hit hit{};
    ASSERT_TRUE(
        intersect_sphere({Vec3(0), infinity, Vec3(0, 0, 1)}, {Vec3(0, 0, 10000), 1}, infinity, hit));
    EXPECT_EQ(hit.t, 9999);
    ASSERT_TRUE(intersect_sphere({Vec3(0, 0, 10000), infinity, Vec3(0, 0, 1)}, {Vec3(0, 0, 10000), 1},
                                 infinity, hit));
    EXPECT_EQ(hit.t, 1);
    EXPECT_FALSE(intersect_sphere({Vec3(0), 9999, Vec3(0, 0, 1)}, {Vec3(0, 0, 10000), 1}, 9999, hit));
    EXPECT_FALSE(
        intersect_sphere({Vec3(0), infinity, Vec3(0, 0, -1)}, {Vec3(0, 0, 10000), 1}, infinity, hit));
}

RC_GTEST_PROP(BoundSpheres, ContainTheSphereAndLittleMore, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    std::vector<Sphere> spheres;
    for (int i = 0; i < 100; ++i)
        spheres.push_back({Vec3(random.magnitude(-20, 20) * random.in_cube()),
                           static_cast<float>(random.magnitude(-20, 20))});
    std::vector<fast::Aabb> boxes(100);
    fast::SerialExecutor{}(100, fast::BoundSpheres{spheres, boxes});
    for (std::size_t i = 0; i < 100; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const double c = spheres[i].center[axis];
            const double r = spheres[i].radius;
            RC_ASSERT(boxes[i].lower[axis] <= c - r && boxes[i].upper[axis] >= c + r);
            // One rounding, one step outwards of at most twice the last place, and one more rounding.
            const double slack = 4 * 0x1p-24;
            RC_ASSERT(boxes[i].lower[axis] >= c - r - slack * std::abs(c - r));
            RC_ASSERT(boxes[i].upper[axis] <= c + r + slack * std::abs(c + r));
        }
}

} // namespace
