// The uniform weights of a course report, a warning example: right where every strategy s = 1 ... k can
// make the path, and too small a sum where one cannot.

#include "ref/transport/bdpt.h"
#include "ref/transport/mis_weight.h"
#include "ref/transport/subpath.h"
#include "tests/ref/transport/estimate.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace {

using ref::Heuristic;
using ref::Vertex;

/// Calls `check` for the paths of 2 to 6 edges by which eye walks in the scene hit an emitter. Returns
/// how many there were.
int for_every_hit(const ref::World& world, const std::function<void(const ref::Path&)>& check)
{
    const ref::PathOptions options{.seed = 3, .max_edges = 6};
    int count = 0;
    for (std::uint32_t i = 0; i < 20'000; ++i) {
        const std::vector<Vertex> z = eye_subpath(world, options, {3, i % (24 * 16), i}, 7);
        if (z.size() < 3 || z.back().emitter == nullptr) continue;
        ref::Path x;
        for (std::size_t t = z.size(); t > 0; --t) x.push_back(&z[t - 1]);
        check(x);
        ++count;
    }
    return count;
}

double sum_of_weights(const ref::World& world, const ref::Path& x)
{
    const ref::PathOptions options{.max_edges = 6, .heuristic = Heuristic::uniform};
    double sum = 0.0;
    for (std::size_t s = 0; s < x.size(); ++s) sum += mis_weight(world, options, x, s);
    return sum;
}

TEST(UniformWeights, OfAPathOverDiffuseSurfacesAddUpToOne)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_diffuse");
    const ref::World world(scene, 24, 16);
    const int hits = for_every_hit(world, [&](const ref::Path& x) {
        ASSERT_NEAR(sum_of_weights(world, x), 1.0, 1e-15 * static_cast<double>(x.size()));
    });
    EXPECT_GT(hits, 500);
}

// Each delta vertex rules out the two strategies that would connect at it, or one at the path's end.
TEST(UniformWeights, OfAPathByWayOfGlassOrAMirrorAddUpToLess)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_glass");
    const ref::World world(scene, 24, 16);
    int by_delta = 0;
    for_every_hit(world, [&](const ref::Path& x) {
        const std::size_t k = x.size() - 1;
        std::size_t possible = 0;
        for (std::size_t s = 1; s <= k; ++s) {
            const bool light_end = s == 1 || scatters(world, *x[s - 1]);
            const bool eye_end = s == k || scatters(world, *x[s]);
            possible += light_end && eye_end ? 1 : 0;
        }
        const bool delta = std::ranges::any_of(x.begin() + 1, x.end() - 1,
                                               [&](const Vertex* v) { return !scatters(world, *v); });
        by_delta += delta ? 1 : 0;
        EXPECT_EQ(delta, possible < k);
        ASSERT_NEAR(sum_of_weights(world, x), static_cast<double>(possible) / static_cast<double>(k),
                    1e-15 * static_cast<double>(x.size()));
    });
    EXPECT_GT(by_delta, 100);
}

// A directly seen emitter is a hit alone, and every other path has no share of a hit.
TEST(UniformWeights, ArePreciselyTheReports)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_glass");
    const ref::World world(scene, 24, 16);
    std::vector<ref::Contribution> all;
    for (std::uint32_t i = 0; i < 24 * 16; ++i)
        trace_bidirectionally(world, {.seed = 3, .max_edges = 5, .heuristic = Heuristic::uniform},
                              {3, i, 0}, all);
    int direct = 0;
    for (const ref::Contribution& c : all) {
        const int k = edges(c);
        direct += k == 1 ? 1 : 0;
        const double of_hits = k == 1 ? 1.0 : 0.0;
        const double of_others = k == 1 ? 0.0 : 1.0 / k;
        ASSERT_EQ(c.weight, c.s == 0 ? of_hits : of_others) << "s = " << c.s << ", t = " << c.t;
    }
    EXPECT_GT(direct, 10);
}

// On a sphere G = 1 / (4 R^2) between any two points, so that even these weights have a variance.
TEST(UniformWeights, MakeTheSamePictureOfADiffuseRoom)
{
    const scenes::Scene scene = transport_test::our_scene("integrating_sphere");
    const ref::World world(scene, 24, 16);
    const auto measured = [&](Heuristic heuristic, std::uint64_t seed) {
        return transport_test::measure(
            transport_test::estimate(world, ref::trace_bidirectionally,
                                     {.batches = 32,
                                      .batch_size = 12,
                                      .path = {.seed = seed, .max_edges = 5, .heuristic = heuristic}}),
            {0, 0, 24, 16}, 1);
    };
    transport_test::expect_equal_means(measured(Heuristic::balance, 51),
                                       measured(Heuristic::uniform, 52), 0.02);
}

} // namespace
