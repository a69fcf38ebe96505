// Every strategy (s, t) alone, unweighted, sample by sample. Strategies whose walks are those of the
// path tracer or the light tracer, from the same numbers, must give the same contributions; those with
// a closed form must give that. The means of the others are tested in light_strategies_test.cpp.

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/subpath.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using ref::Contribution;
using ref::Rgb;

constexpr int longest = 6;

/// Emission hits and next events of one sample, by length.
std::vector<Contribution> sample(const ref::World& world, ref::Integrator integrator,
                                 const ref::PathOptions& options, const ref::SampleId& id)
{
    std::vector<Contribution> out;
    integrator(world, options, id, out);
    std::erase_if(out, [](const Contribution& c) { return c.s > 1 || c.t == 1; });
    std::ranges::sort(out, {}, [](const Contribution& c) { return 2 * c.t + c.s; });
    return out;
}

class EyeStrategies : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EyeStrategies,
                         testing::Values("cornell_diffuse", "cornell_glass", "all_emitters", "furnace",
                                         "furnace_grey", "camera_in_glass", "camera_in_glass_furnace",
                                         "light_in_glass", "mirror_image", "integrating_sphere",
                                         "integrating_sphere_lamp", "door_ajar", "point_in_glass"),
                         [](const auto& name) { return std::string(name.param); });

// Both do the same operations on the same numbers in different orders: the weight of a walk is a
// product of at most 3 factors per vertex; next event divides by a density or multiplies by a
// geometric term. 1e-12 leaves room for 1e4 roundoffs; there is no cancellation.
TEST_P(EyeStrategies, AreThoseOfThePathTracerSampleBySample) // map: emission-hit, next-event
{
    const scenes::Scene scene = transport_test::our_scene(GetParam());
    const ref::World world(scene, 24, 16);
    std::size_t compared = 0;
    for (std::uint32_t i = 0; i < 24 * 16 * 4; ++i) {
        const ref::SampleId id{11, i % (24 * 16), i};
        for (const int max_edges : {longest, 12}) {
            const ref::PathOptions options{.seed = 11, .max_edges = max_edges};
            const auto path = sample(world, ref::trace_path, options, id);
            const auto both = sample(world, ref::trace_bidirectionally, options, id);
            ASSERT_EQ(path.size(), both.size());
            for (std::size_t j = 0; j < path.size(); ++j) {
                ASSERT_EQ(path[j].s, both[j].s);
                ASSERT_EQ(path[j].t, both[j].t);
                ASSERT_EQ(path[j].pixel, both[j].pixel);
                for (int channel = 0; channel < 3; ++channel)
                    ASSERT_NEAR(path[j].value[channel], both[j].value[channel],
                                1e-12 * path[j].value[channel]);
                ++compared;
            }
        }
    }
    const bool only_light_walks_see = std::string(GetParam()) == "point_in_glass";
    EXPECT_EQ(compared > 50, !only_light_walks_see);
}

class LightTracing : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, LightTracing,
                         testing::Values("cornell_glass", "all_emitters", "light_in_glass",
                                         "integrating_sphere"),
                         [](const auto& name) { return std::string(name.param); });

// The same walks and the same function: all bits are equal except for the weights, which are 1.
TEST_P(LightTracing, IsTheLightImageAlone)
{
    const scenes::Scene scene = transport_test::our_scene(GetParam());
    const ref::World world(scene, 24, 16);
    std::vector<Contribution> light;
    std::vector<Contribution> both;
    for (std::uint32_t i = 0; i < 24 * 16 * 4; ++i) {
        const ref::SampleId id{12, i % (24 * 16), i};
        trace_light(world, {.seed = 12, .max_edges = longest}, id, light);
        trace_bidirectionally(world, {.seed = 12, .max_edges = longest}, id, both);
    }
    std::erase_if(both, [](const Contribution& c) { return c.t != 1; });
    ASSERT_GT(light.size(), 50U);
    ASSERT_EQ(light.size(), both.size());
    for (std::size_t i = 0; i < light.size(); ++i) {
        EXPECT_EQ(light[i].s, both[i].s);
        EXPECT_EQ(light[i].t, 1);
        EXPECT_EQ(light[i].pixel, both[i].pixel);
        EXPECT_EQ(light[i].value, both[i].value);
        EXPECT_EQ(light[i].weight, 1.0);
    }
}

// In the integrating sphere every pair of points of the wall exchanges the same light, cos cos' / d^2
// = 1 / (4 R^2), so a connection is not random. Each is rho^(k-1) I / (pi R^2), up to the roundoff of
// the distance from a difference of coordinates, squared, and of two cosines. For two points closer
// than 1e-4 R the error may be 1e-16 / 1e-8 / 1e-4; no pair here is so close.
TEST(Connections, InTheIntegratingSphereAreAllTheSame) // map: geometric-term, inner-connection
{
    const scenes::Scene scene = transport_test::our_scene("integrating_sphere");
    const ref::World world(scene, 16, 16);
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[scene.spheres[0].material]).albedo;
    std::vector<int> count(longest + 1, 0);
    std::vector<Contribution> out;
    for (std::uint32_t i = 0; i < 16 * 16 * 16; ++i) {
        out.clear();
        trace_bidirectionally(world, {.seed = 4, .max_edges = longest, .roulette = false},
                              {4, i % 256, i / 256}, out);
        for (const Contribution& c : out) {
            if (c.s < 2 || c.t < 2) continue;
            const int k = edges(c);
            ++count[static_cast<std::size_t>(k)];
            for (int channel = 0; channel < 3; ++channel) {
                const double expected = std::pow(rho[channel], k - 1) *
                                        scene.point_lights[0].intensity[channel] / std::numbers::pi;
                ASSERT_NEAR(c.value[channel], expected, 1e-9 * expected);
            }
        }
    }
    // No pair is left out, however close its ends: k - 2 pairs for each sample.
    for (int k = 3; k <= longest; ++k) EXPECT_EQ(count[static_cast<std::size_t>(k)], (k - 2) * 4096);
}

// Walks that bounce by the same numbers leave their first surfaces at the same angle. Each sample is
// then a special pair of walks, and the mean over all pairs is lost. Of 384 pairs of other walks, two
// angles agree to 1e-9 with a probability of about 1e-6.
TEST(Walks, OfTheEyeAndTheLightBounceByNumbersOfTheirOwn)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_diffuse");
    const ref::World world(scene, 24, 16);
    const auto first_cosine = [](const std::vector<ref::Vertex>& walk) {
        return cosine(walk[1], direction(walk[1], walk[2]));
    };
    int pairs = 0;
    for (std::uint32_t i = 0; i < 24 * 16; ++i) {
        const auto z = eye_subpath(world, {}, {13, i, 0}, 3);
        const auto y = light_subpath(world, {}, {13, i, 0}, 3);
        if (z.size() < 3 || y.size() < 3) continue;
        ++pairs;
        EXPECT_GT(std::abs(first_cosine(z) - first_cosine(y)), 1e-9);
    }
    EXPECT_GT(pairs, 100);
}

} // namespace
