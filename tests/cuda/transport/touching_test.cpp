// Contacts are decided by a rule and not by rounding. In random rooms with surfaces that coincide, and
// with lights and eyes on surfaces, all integrators of both wings agree with each other and with the
// limit of a small gap.
//
// Both wings could be wrong in the same way; the limit would show this. It is rendered by path
// tracing, which never finds the only difference between a light on a wall and a light close to it: a
// spot, as small as the gap, that receives half of the light's power.
//
// A comparison of two integrators is a t test on the means of whole pictures over independent batches.
// The bound of 7 standard errors with 31 degrees of freedom is exceeded by chance once in 10^7 times.

#include "tests/cuda/transport/batch_means.h"
#include "tests/cuda/transport/touching_scenes.h"

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

namespace {

using fast_transport_test::Touching;

using fast_transport_test::average;
using fast_transport_test::error_of;
using fast_transport_test::Means;

constexpr fast_transport_test::Samples samples{.size = 16, .batches = 32, .batch_size = 4};
constexpr double bound = 7;

Means by_ref(const scenes::Scene& scene, ref::Integrator integrator, int max_edges, std::uint64_t seed)
{
    return fast_transport_test::means_by_ref(scene, integrator, max_edges, seed, samples);
}

Means by_host(const scenes::Scene& scene, fast::Integrator integrator, int max_edges, std::uint64_t seed)
{
    return fast_transport_test::means_by_host(scene, integrator, max_edges, seed, samples);
}

void expect_agree(const Means& a, const Means& b, const char* what)
{
    const double error = std::hypot(error_of(a), error_of(b));
    EXPECT_LT(std::abs(average(a) - average(b)), bound * error)
        << what << ": " << average(a) << ", " << average(b) << ", standard error " << error;
}

/// From the same random numbers: differences come only from paths that rounding changes.
void expect_agree_paired(const Means& a, const Means& b, double tolerance, const char* what)
{
    Means differences;
    for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(a[i] - b[i]);
    EXPECT_LT(std::abs(average(differences)), bound * error_of(differences) + tolerance * average(a))
        << what << ": " << average(a) << ", " << average(b);
}

/// The result of path tracing for a scene of that kind in the limit of a small gap.
Means limit_of(Touching kind, std::uint32_t seed, int max_edges)
{
    const auto path = [&](const scenes::Scene& scene) {
        return by_ref(scene, ref::trace_path, max_edges, seed);
    };
    constexpr double gap = 1e-6;
    Means limit = path(fast_transport_test::touching_scene(kind, seed, gap));
    if (kind != Touching::point_light_on_lamp) return limit;
    // This lamp has two sides, and the light shines to both: adds its contribution on the one side to
    // that on the other.
    const Means above = path(fast_transport_test::touching_scene(kind, seed, -gap));
    scenes::Scene without = fast_transport_test::touching_scene(kind, seed, 0);
    without.point_lights.clear();
    const Means neither = path(without);
    for (std::size_t i = 0; i < limit.size(); ++i) limit[i] += above[i] - neither[i];
    return limit;
}

class TouchingScenes : public testing::TestWithParam<Touching> {};

TEST_P(TouchingScenes, AreTheSameForAllIntegratorsOnBothWingsAndInTheLimit)
{
    const Touching kind = GetParam();
    const std::uint32_t seeds = std::getenv("PLUMBLINE_LONG") != nullptr ? 300 : 1;
    const bool has_glass = kind == Touching::glass_on_floor; // light tracing cannot see through it
    const int max_edges = has_glass ? 8 : 4;
    for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const scenes::Scene scene = fast_transport_test::touching_scene(kind, seed, 0);
        const Means path = by_ref(scene, ref::trace_path, max_edges, seed);
        const Means bdpt = by_ref(scene, ref::trace_bidirectionally, max_edges, seed + 1000);
        EXPECT_LT(error_of(path), 0.04 * average(path)); // otherwise the comparisons would be weak
        EXPECT_LT(error_of(bdpt), 0.04 * average(bdpt));
        expect_agree(path, bdpt, "path and bdpt");
        if (!has_glass)
            expect_agree(by_ref(scene, ref::trace_light, max_edges, seed + 2000), bdpt,
                         "light and bdpt");

        // A sample in 2^14 that rounding changes changes the mean by about as much.
        expect_agree_paired(by_host(scene, fast::Integrator::path, max_edges, seed), path, 1e-4,
                            "path on both wings");
        expect_agree_paired(by_host(scene, fast::Integrator::bdpt, max_edges, seed + 1000), bdpt, 1e-4,
                            "bdpt on both wings");

        expect_agree_paired(limit_of(kind, seed, max_edges), path, 1e-4, "path and its limit");
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, TouchingScenes,
                         testing::Values(Touching::point_light_on_lamp, Touching::point_light_on_wall,
                                         Touching::point_light_in_corner,
                                         Touching::point_light_on_sphere, Touching::spot_light_on_wall,
                                         Touching::eye_on_wall, Touching::eye_in_edge,
                                         Touching::lamp_in_wall, Touching::lamps_back_to_back,
                                         Touching::lamp_under_lamp, Touching::glass_on_floor),
                         [](const testing::TestParamInfo<Touching>& kind) {
                             return fast_transport_test::name_of(kind.param);
                         });

} // namespace
