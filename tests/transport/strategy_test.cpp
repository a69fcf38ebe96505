// Every strategy (s, t) by itself, unweighted: on scenes where it can make every path of s + t - 1
// edges, its mean is all light of that length. The emission hit and next event walk as the path tracer
// does, from the same numbers, and are compared sample by sample; the others by means, against closed
// forms where there are any.

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "tests/transport/estimate.h"
#include "tests/transport/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace {

using ref::Contribution;
using ref::Rgb;

constexpr int longest = 6;
constexpr int strategies = (longest + 1) * (longest + 1);

/// One class per strategy of 1 ... `longest` edges.
int strategy(int s, int t)
{
    return s * (longest + 1) + t - 1;
}

int classify(const Contribution& c)
{
    return edges(c) <= longest ? strategy(c.s, c.t) : -1;
}

/// PLUMBLINE_LONG multiplies the samples, for a night's run; bounds on the detectable bias stay.
int effort()
{
    return std::getenv("PLUMBLINE_LONG") != nullptr ? 16 : 1;
}

scenes::Scene scene_for_strategies(const std::string& name)
{
    scenes::Scene scene = tests::our_scene(name);
    if (name == "furnace_grey") { // all spheres grey: nothing is delta, and more than two edges matter
        for (auto& sphere : scene.spheres) {
            sphere.material = scene.spheres[0].material;
            sphere.center.x /= 4.0;
        }
        scene.camera->eye.y /= 4.0;
        scene.camera->fov = 1.2;
    }
    return scene;
}

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

// Both do the same operations on the same numbers, in another order: a weight of the walk is a product
// of at most 3 factors a vertex, next event divides by a density or multiplies by a geometric term.
// 1e-12 leaves room for 1e4 roundoffs; cancellation there is none.
TEST_P(EyeStrategies, AreThoseOfThePathTracerSampleBySample)
{
    const scenes::Scene scene = tests::our_scene(GetParam());
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

/// A scene, how it is sampled, and which relative bias a comparison of whole pictures finds with 99%
/// power (quarters of the picture: three times that). A joined pair of vertices in a corner counts with
/// 1 / d^2, of which the variance has no bound: connections alone are known less well than the rest.
struct Case {
    const char* name;
    const char* scene;
    int batch_size; // samples per pixel of each of 32 batches; the reference has four times as many
    int edges;      // the longest paths compared
    double light_image, inner;
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.name;
}

class LightStrategies : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Scenes, LightStrategies,
    testing::Values(Case{"integrating_sphere", "integrating_sphere", 8, 5, 0.08, 0.02},
                    Case{"integrating_sphere_lamp", "integrating_sphere_lamp", 8, 4, 0.16, 0.08},
                    Case{"cornell_diffuse", "cornell_diffuse", 6, 4, 0.12, 0.6},
                    Case{"cornell_diffuse_short", "cornell_diffuse", 32, 2, 0.03, 0.03},
                    Case{"furnace_grey", "furnace_grey", 32, 2, 0.05, 0.05},
                    Case{"sphere_over_plane", "sphere_over_plane", 64, 2, 0.03, 0.03},
                    Case{"all_emitters", "all_emitters", 48, 2, 0.15, 0.15},
                    Case{"ceiling_lamp", "ceiling_lamp", 6, 4, 0.2, 0.3}),
    [](const auto& name) { return std::string(name.param.name); });

TEST_P(LightStrategies, MakeAllLightOfTheirLength)
{
    const Case& c = GetParam();
    const scenes::Scene scene = scene_for_strategies(c.scene);
    constexpr int width = 24;
    constexpr int height = 16;
    const ref::World world(scene, width, height);
    const tests::EstimateOptions options{.batches = 32,
                                         .batch_size = c.batch_size * effort(),
                                         .weighted = false,
                                         .path = {.seed = 31, .max_edges = c.edges, .roulette = false}};
    tests::EstimateOptions reference = options;
    reference.weighted = true;
    reference.batch_size *= 4;
    reference.path.seed = 32;
    const auto by_strategy =
        tests::estimate(world, ref::trace_bidirectionally, options, strategies, classify);
    const auto by_length = tests::estimate(world, ref::trace_path, reference, longest + 1,
                                           [](const Contribution& p) { return edges(p); });
    for (int k = 1; k <= c.edges; ++k)
        for (int s = 1; s <= k; ++s) {
            const int t = k + 1 - s;
            if (s == 1 && t > 1) continue; // next event: see above
            SCOPED_TRACE("s = " + std::to_string(s) + ", t = " + std::to_string(t));
            const auto& light = by_strategy[static_cast<std::size_t>(strategy(s, t))];
            const auto& eye = by_length[static_cast<std::size_t>(k)];
            // What is longer is darker and noisier.
            const double specification = (t == 1 ? c.light_image : c.inner) / std::sqrt(effort());
            for (int channel = 0; channel < 3; ++channel)
                tests::expect_equal_means(tests::measure(light, {0, 0, width, height}, channel),
                                          tests::measure(eye, {0, 0, width, height}, channel),
                                          specification);
            for (const tests::Region& quarter : {tests::Region{0, 0, width / 2, height / 2},
                                                 {width / 2, 0, width, height / 2},
                                                 {0, height / 2, width / 2, height},
                                                 {width / 2, height / 2, width, height}}) {
                const auto part = tests::measure(eye, quarter, 1);
                if (part.mean < 0.1 * tests::measure(eye, {0, 0, width, height}, 1).mean) continue;
                tests::expect_equal_means(tests::measure(light, quarter, 1), part, 3.0 * specification);
            }
        }
}

// In the integrating sphere every pair of points of the wall exchanges the same light,
// cos cos' / d^2 = 1 / (4 R^2): a connection is no longer random. Each is rho^(k-1) I / (pi R^2), to the
// roundoff of the distance from a difference of coordinates, squared, and of two cosines: for two points
// closer than 1e-4 R it may be 1e-16 / 1e-8 / 1e-4, which no pair here is.
TEST(Connections, InTheIntegratingSphereAreAllTheSame)
{
    const scenes::Scene scene = tests::our_scene("integrating_sphere");
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
    // None is left out, however close its ends: k - 2 pairs for each sample.
    for (int k = 3; k <= longest; ++k) EXPECT_EQ(count[static_cast<std::size_t>(k)], (k - 2) * 4096);
}

} // namespace
