// A fixed distance by which rays leave surfaces, a warning example: what is nearer is missed.

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/visibility.h"
#include "scenes/placed.h"
#include "tests/ref/transport/changed_scene.h"
#include "tests/ref/transport/contributions.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using ref::Builder;
using ref::Contribution;
using ref::Vec3;
using ref::World;

/// The contributions of 3000 samples of a picture of 24 x 16 pixels, with rays that leave by `epsilon`.
std::vector<Contribution> with_epsilon(const scenes::Scene& scene, ref::Integrator integrator,
                                       int max_edges, double epsilon)
{
    const World world(scene, 24, 16, Builder::sah_leaf, epsilon);
    std::vector<Contribution> out;
    for (std::uint32_t i = 0; i < 3000; ++i)
        integrator(world, {.seed = 9, .max_edges = max_edges}, {9, i % (24 * 16), i}, out);
    return out;
}

// The lamp's whole light is blocked in the middle of the plane, by a card 0.04 below it: |x'|, |y'| <
// 0.27 from the axis (near_occluder.dae). With the scene at a tenth of its size, a hundredth is more
// than the distance between lamp and card: segments to the lamp end before the card, and its shadow is
// gone.
TEST(Epsilon, ThatIsLargerThanAGapLeaksLightThroughIt)
{
    const scenes::Scene scene = transport_test::scaled(transport_test::our_scene("near_occluder"), 0.1);
    const auto light_in_shadow = [&](double epsilon) {
        const World world(scene, 60, 40, Builder::sah_leaf, epsilon);
        std::vector<Contribution> out;
        int lit = 0;
        int in_shadow = 0;
        for (std::uint32_t i = 0; i < 8 * 60 * 40; ++i) {
            const ref::SampleId id{5, i % (60 * 40), i};
            const ref::Ray ray = camera_ray(world, id);
            const Vec3 p = ray.origin - ray.origin.z / ray.direction.z * ray.direction;
            if (std::abs(p.x + 0.02) > 0.026 || std::abs(p.y - 0.06) > 0.026) continue;
            out.clear();
            trace_path(world, {.seed = 5, .max_edges = 2}, id, out);
            ++in_shadow;
            lit += out.empty() ? 0 : 1;
        }
        EXPECT_GT(in_shadow, 50);
        return std::pair(lit, in_shadow);
    };
    EXPECT_EQ(light_in_shadow(0.0).first, 0);
    EXPECT_EQ(light_in_shadow(0.0039).first, 0);
    const auto [lit, in_shadow] = light_in_shadow(0.01);
    EXPECT_EQ(lit, in_shadow);
}

// The origins of rays move along the rays by 1e-6 where they moved along the normal by a bound of some
// 1e-15: the rays are the same up to rounding. Another contribution than before is made only where a ray
// crosses another surface within 1e-6 of an end. That takes an end as near as that to an edge of the
// room, which is about one unit large: some 1e-6 of all segments, and these samples have less than 1e5.
// What is left is rounding: 1e-15 in each origin, magnified by at most some tens at each of four
// bounces, is 1e-8 at most if two of them are on the glass sphere.
TEST(Epsilon, OfAMillionthChangesTheCornellBoxByRoundingAlone)
{
    for (const char* name : {"cornell_diffuse", "cornell_glass"}) {
        const scenes::Scene scene = scenes::placed(transport_test::our_scene(name));
        for (const auto integrator : {ref::trace_path, ref::trace_bidirectionally}) {
            const auto exact = with_epsilon(scene, integrator, 5, 0.0);
            const auto moved = with_epsilon(scene, integrator, 5, 1e-6);
            EXPECT_EQ(transport_test::different(exact, moved, 1e-7), 0u) << name;
            EXPECT_GT(exact.size(), 1000u);
            const auto much = with_epsilon(scene, integrator, 5, 1e-2);
            EXPECT_GT(transport_test::different(exact, much, 1e-7), exact.size() / 100) << name;
        }
    }
}

// Two points that are nearer to each other than twice the distance see each other: nothing of the
// segment is left that could be blocked.
TEST(Epsilon, MakesNeighboursVisible)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_diffuse");
    const World exact(scene, 4, 4);
    const World leaky(scene, 4, 4, Builder::sah_leaf, 10.0);
    const Vec3 middle(1.0 / 3.0);
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i)
        for (std::uint32_t j = 0; j < scene.triangles.size(); ++j) {
            if (i == j) continue;
            const auto a = triangle_point(leaky.geometry, i, middle);
            const auto b = triangle_point(leaky.geometry, j, middle);
            ASSERT_TRUE(visible(leaky.geometry, a, b));
            ASSERT_TRUE(visible(leaky.geometry, a, b.position));
        }
    int hidden = 0;
    for (std::uint32_t i = 1; i < scene.triangles.size(); ++i)
        hidden += visible(exact.geometry, triangle_point(exact.geometry, 0, middle),
                          triangle_point(exact.geometry, i, middle))
                      ? 0
                      : 1;
    EXPECT_GT(hidden, 0);
}

TEST(Epsilon, ThatIsNoLengthIsRefused)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_diffuse");
    for (const double epsilon : {-1.0, 1e101, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(World(scene, 4, 4, Builder::sah_leaf, epsilon), std::invalid_argument);
}

} // namespace
