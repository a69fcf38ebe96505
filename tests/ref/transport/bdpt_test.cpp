// Bidirectional path tracing and light tracing as a whole: compared with path tracing, and by their
// rules.

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "tests/ref/transport/contributions.h"
#include "tests/ref/transport/estimate.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace {

using ref::Contribution;

/// With PLUMBLINE_LONG, multiplies the samples, for a run overnight.
int effort()
{
    return std::getenv("PLUMBLINE_LONG") != nullptr ? 16 : 1;
}

/// A scene, its samples per batch, its longest paths, and the relative biases of a whole picture that
/// are detected with 99% power when path tracing or light tracing is compared with bidirectional path
/// tracing. In quarters of the picture the detectable bias is three times as large. Both have four
/// times the samples. 0 means that light tracing misses paths, because a mirror or glass is between a
/// scattering surface and the eye.
struct Case {
    const char* scene;
    int batch_size;
    int edges;
    double path, light;
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.scene;
}

class Integrators : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Scenes, Integrators,
    testing::Values(
        Case{"all_emitters", 8, 4, 0.12, 0.15}, Case{"area_light_over_plane", 4, 3, 0.05, 0.1},
        Case{"camera_in_glass", 12, 5, 0.12, 0.0}, Case{"camera_in_glass_furnace", 2, 6, 0.06, 0.0},
        Case{"ceiling_lamp", 2, 5, 0.3, 0.08}, Case{"cornell_diffuse", 3, 5, 0.06, 0.08},
        Case{"cornell_glass", 3, 6, 0.15, 0.0}, Case{"directional_over_plane", 4, 3, 0.05, 0.15},
        Case{"door_ajar", 3, 5, 1.5, 0.7}, Case{"furnace", 2, 6, 0.03, 0.0},
        Case{"furnace_grey", 12, 4, 0.03, 0.0}, Case{"integrating_sphere", 2, 6, 0.03, 0.1},
        Case{"integrating_sphere_lamp", 3, 6, 0.06, 0.15}, Case{"light_in_glass", 32, 4, 0.3, 0.0},
        Case{"mirror_image", 8, 4, 0.09, 0.0}, Case{"near_occluder", 8, 3, 0.06, 0.1},
        Case{"point_over_plane", 4, 3, 0.05, 0.1}, Case{"sphere_over_plane", 8, 3, 0.05, 0.1},
        Case{"spot_over_plane", 4, 3, 0.05, 0.1}),
    [](const auto& name) { return std::string(name.param.scene); });

void expect_same_pictures(const transport_test::Batches& a, const transport_test::Batches& b,
                          double specification)
{
    const int w = a.front().width;
    const int h = a.front().height;
    for (int channel = 0; channel < 3; ++channel)
        transport_test::expect_equal_means(transport_test::measure(a, {0, 0, w, h}, channel),
                                           transport_test::measure(b, {0, 0, w, h}, channel),
                                           specification);
    for (const transport_test::Region& quarter : {transport_test::Region{0, 0, w / 2, h / 2},
                                                  {w / 2, 0, w, h / 2},
                                                  {0, h / 2, w / 2, h},
                                                  {w / 2, h / 2, w, h}}) {
        const auto p = transport_test::measure(a, quarter, 1);
        if (p.mean < 0.1 * transport_test::measure(a, {0, 0, w, h}, 1).mean) continue;
        transport_test::expect_equal_means(p, transport_test::measure(b, quarter, 1),
                                           3.0 * specification);
    }
}

TEST_P(Integrators, MakeTheSamePicture)
{
    const Case& c = GetParam();
    const scenes::Scene scene = transport_test::our_scene(c.scene);
    const ref::World world(scene, 24, 16);
    const auto picture = [&](ref::Integrator integrator, std::uint64_t seed, int more) {
        return transport_test::estimate(world, integrator,
                                        {.batches = 32,
                                         .batch_size = more * c.batch_size * effort(),
                                         .path = {.seed = seed, .max_edges = c.edges}});
    };
    const double root = std::sqrt(effort());
    const auto both = picture(ref::trace_bidirectionally, 42, 1);
    {
        SCOPED_TRACE("path tracing");
        expect_same_pictures(picture(ref::trace_path, 41, 4), both, c.path / root);
    }
    if (c.light > 0.0) {
        SCOPED_TRACE("light tracing");
        expect_same_pictures(picture(ref::trace_light, 44, 4), both, c.light / root);
    }
}

// Another heuristic distributes the same light in another way. The weights of each path add up to 1
// (mis_weight_test.cpp); here this is tested for the mean.
TEST(Heuristics, MakeTheSamePicture)
{
    const scenes::Scene scene = transport_test::our_scene("all_emitters");
    const ref::World world(scene, 24, 16);
    const auto picture = [&](ref::Heuristic heuristic, std::uint64_t seed) {
        return transport_test::estimate(
            world, ref::trace_bidirectionally,
            {.batches = 32,
             .batch_size = 12,
             .path = {.seed = seed, .max_edges = 4, .heuristic = heuristic}});
    };
    expect_same_pictures(picture(ref::Heuristic::balance, 45), picture(ref::Heuristic::power, 46), 0.12);
}

// No contribution is longer than max_edges, and none up to that length is missing. A smaller max_edges
// leaves out exactly the longer paths and changes no other weight, since no strategy of a shorter path
// depends on longer walks.
TEST(MaxEdges, LeavesOutTheLongerPathsAlone)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_glass");
    std::vector<Contribution> all =
        transport_test::contributions(scene, ref::trace_bidirectionally, 9, 1000);
    for (int k = 8; k >= 1; --k) {
        std::erase_if(all, [&](const Contribution& c) { return edges(c) > k; });
        const auto fewer = transport_test::contributions(scene, ref::trace_bidirectionally, k, 1000);
        EXPECT_EQ(transport_test::different(all, fewer, 0.0), 0u) << k;
    }
    EXPECT_FALSE(all.empty());
}

TEST(Roulette, ChangesNothingInTheMean)
{
    const scenes::Scene scene = transport_test::our_scene("integrating_sphere_lamp");
    const ref::World world(scene, 12, 12);
    for (const auto integrator : {ref::trace_bidirectionally, ref::trace_light}) {
        const auto long_paths = [&](bool roulette, std::uint64_t seed) {
            const auto batches = transport_test::estimate(
                world, integrator,
                {.batches = 32,
                 .batch_size = 16,
                 .path = {.seed = seed, .max_edges = 9, .roulette = roulette}},
                1, [](const Contribution& c) { return edges(c) >= 6 ? 0 : -1; });
            return transport_test::measure(batches[0], {0, 0, 12, 12}, 1);
        };
        transport_test::expect_equal_means(long_paths(true, 1), long_paths(false, 2),
                                           integrator == ref::trace_light ? 0.25 : 0.1);
    }
}

} // namespace
