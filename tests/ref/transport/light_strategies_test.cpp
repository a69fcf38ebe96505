// The strategies that need a light walk, (s, 1) and (s, t) with s, t >= 2, each alone and unweighted.
// On scenes where such a strategy can make every path of s + t - 1 edges, its mean is all light of
// that length, equal to that of the path tracer. Every comparison prints the bias that it would detect
// with a power of 99%.

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "tests/ref/transport/estimate.h"
#include "tests/ref/transport/rounded_room.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace {

using ref::Contribution;
using transport_test::Measured;
using transport_test::Region;

constexpr int longest = 5;
constexpr int width = 16;
constexpr int height = 16;

/// The relative bias of a tile's mean that must be detectable: for the light image, and for inner
/// connections.
struct Power {
    double light_image, inner;
};

/// PLUMBLINE_LONG multiplies the samples by `longer`: a quarter of an hour in total. The detectable
/// bias then shrinks with the square root, except for connections in corners, whose variance is not
/// finite.
struct Case {
    const char* name;
    int batch_size; // samples per pixel of each of 64 batches; for path and light tracing times 4
    int edges;      // the longest paths compared
    Power power;
    int longer;
    Power power_then;
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.name;
}

scenes::Scene scene_of(const std::string& name)
{
    if (name == "rounded_room_lamp") return transport_test::rounded_room(true);
    if (name == "rounded_room_point") return transport_test::rounded_room(false);
    scenes::Scene scene = transport_test::our_scene(name);
    if (name == "furnace_grey") { // all spheres grey: no delta material; long paths matter
        for (auto& sphere : scene.spheres) {
            sphere.material = scene.spheres[0].material;
            sphere.center.x /= 4.0;
        }
        scene.camera->eye.y /= 4.0;
        scene.camera->fov = 1.2;
    }
    return scene;
}

/// The relative bias that the comparison of two means detects with a power of 99%.
double detectable(const Measured& a, const Measured& b)
{
    return transport_test::detectable_bias(std::hypot(a.standard_error, b.standard_error),
                                           std::min(a.batches, b.batches) - 1.0) /
           b.mean;
}

class LightStrategies : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Scenes, LightStrategies,
    testing::Values(Case{"rounded_room_lamp", 4, 5, {0.1, 0.1}, 110, {0.01, 0.01}},
                    Case{"rounded_room_point", 4, 5, {0.08, 0.08}, 80, {0.01, 0.01}},
                    Case{"integrating_sphere", 4, 5, {0.09, 0.02}, 64, {0.0125, 0.003}},
                    Case{"integrating_sphere_lamp", 4, 4, {0.45, 0.3}, 16, {0.13, 0.09}},
                    Case{"cornell_diffuse", 3, 4, {0.25, 1.2}, 16, {0.08, 1.2}},
                    Case{"furnace_grey", 12, 2, {0.08, 0.08}, 44, {0.014, 0.014}},
                    Case{"sphere_over_plane", 12, 2, {0.06, 0.06}, 36, {0.011, 0.011}},
                    Case{"all_emitters", 12, 2, {0.16, 0.16}, 16, {0.045, 0.045}},
                    Case{"ceiling_lamp", 3, 4, {0.5, 0.8}, 16, {0.16, 1.2}}),
    [](const auto& name) { return std::string(name.param.name); });

TEST_P(LightStrategies, MakeAllLightOfTheirLength) // map: light-image, inner-connection
{
    const Case& c = GetParam();
    const bool at_length = std::getenv("PLUMBLINE_LONG") != nullptr;
    const Power specification = at_length ? c.power_then : c.power;
    const scenes::Scene scene = scene_of(c.name);
    const ref::World world(scene, width, height);
    const auto estimated = [&](ref::Integrator integrator, std::uint64_t seed, int more, bool weighted,
                               const transport_test::Classify& classify) {
        const transport_test::EstimateOptions options{
            .batches = 64,
            .batch_size = more * c.batch_size * (at_length ? c.longer : 1),
            .weighted = weighted,
            .path = {.seed = seed, .max_edges = c.edges, .roulette = false}};
        return transport_test::estimate(world, integrator, options, (longest + 1) * (longest + 1),
                                        classify);
    };
    const auto strategy = [](int s, int t) { return s * (longest + 1) + t - 1; };
    const auto by_length =
        estimated(ref::trace_path, 32, 4, true, [](const Contribution& p) { return edges(p); });
    const auto light_images = estimated(ref::trace_light, 33, 4, false,
                                        [&](const Contribution& p) { return strategy(p.s, p.t); });
    const auto connections =
        estimated(ref::trace_bidirectionally, 31, 1, false,
                  [&](const Contribution& p) { return p.s >= 2 && p.t >= 2 ? strategy(p.s, p.t) : -1; });

    for (int k = 1; k <= c.edges; ++k)
        for (int s = 1; s <= k; ++s) {
            const int t = k + 1 - s;
            if (s == 1 && t > 1) continue; // next event: see strategy_test.cpp
            SCOPED_TRACE("s = " + std::to_string(s) + ", t = " + std::to_string(t));
            const auto& light =
                (t == 1 ? light_images : connections)[static_cast<std::size_t>(strategy(s, t))];
            const auto& eye = by_length[static_cast<std::size_t>(k)];
            const double bound = t == 1 ? specification.light_image : specification.inner;
            const Region whole = {0, 0, width, height};
            for (int channel = 0; channel < 3; ++channel)
                transport_test::expect_equal_means(transport_test::measure(light, whole, channel),
                                                   transport_test::measure(eye, whole, channel), bound);
            const Measured all = transport_test::measure(eye, whole, 1);
            if (all.mean == 0.0) continue;
            double worst = 0.0;
            for (const Region& tile : {Region{0, 0, width / 2, height / 2},
                                       {width / 2, 0, width, height / 2},
                                       {0, height / 2, width / 2, height},
                                       {width / 2, height / 2, width, height}}) {
                const Measured part = transport_test::measure(eye, tile, 1);
                if (part.mean < 0.1 * all.mean) continue;
                const Measured same = transport_test::measure(light, tile, 1);
                transport_test::expect_equal_means(same, part, bound);
                worst = std::max(worst, detectable(same, part));
            }
            std::printf("[ POWER    ] %-23s s = %d, t = %d: whole %.2f%%, tiles %.2f%%\n", c.name, s, t,
                        100.0 * detectable(transport_test::measure(light, whole, 1), all),
                        100.0 * worst);
        }
}

} // namespace
