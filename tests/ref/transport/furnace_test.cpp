// Closed rooms where the same light comes from all sides, or where light returns: the picture is known
// for any bounces. The formulas are in the comments at the heads of the scenes.

#include "tests/ref/transport/integrators.h"
#include "tests/ref/transport/known_light.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <glm/exponential.hpp>

#include <numbers>
#include <string>

namespace {

using ref::Contribution;
using ref::Rgb;
using transport_test::Line;

class Furnace : public transport_test::OfEveryIntegrator {};

INSTANTIATE_TEST_SUITE_P(Integrators, Furnace, transport_test::integrators(), transport_test::name_of);

int by_edges(const Contribution& c)
{
    return edges(c);
}

// White objects: the sky that a walk finally hits has lost nothing on any walk. Without roulette this
// holds for every single sample, and every walk hits the sky: a diffuse bounce leaves the open box
// with a probability of at least one in ten, so no walk is left after 1000 bounces. Rounding: below
// 1e-15 per bounce.
TEST(FurnaceBySample, EveryWalkBringsHomeTheWholeSky)
{
    const scenes::Scene scene = transport_test::our_scene("furnace");
    const ref::World world(scene, 24, 16);
    transport_test::for_every_sample(world, ref::trace_path,
                                     {.seed = 31, .max_edges = 1000, .roulette = false}, 8,
                                     [&](const Line&, const std::vector<Contribution>& all) {
                                         Rgb sky(0.0);
                                         for (const Contribution& c : all)
                                             if (c.s == 0) sky += c.value;
                                         for (int i = 0; i < 3; ++i)
                                             ASSERT_NEAR(sky[i] / (*scene.environment)[i], 1.0, 1e-12);
                                     });
}

// With roulette, the probability to survive a bounce, from the first one that it may end, is at most
// 0.95 (on white, exactly 0.95), and the weight of a walk that survives must grow accordingly.
TEST(FurnaceBySample, WhatSurvivesRouletteBringsTheOthersShare) // map: roulette, throughput
{
    const scenes::Scene scene = transport_test::our_scene("furnace");
    const ref::World world(scene, 24, 16);
    for (const int from : {1, 5, 8}) {
        int walks = 0;
        int long_walks = 0;
        transport_test::for_every_sample(
            world, ref::trace_path, {.seed = 32, .roulette_from = from}, 8,
            [&](const Line&, const std::vector<Contribution>& all) {
                ++walks;
                for (const Contribution& c : all) {
                    if (c.s != 0) continue;
                    const int risked = std::max(0, c.t - 2 - (from - 1));
                    ASSERT_NEAR(c.value.x / scene.environment->x * std::pow(0.95, risked), 1.0, 1e-12);
                    long_walks += risked > 0 ? 1 : 0;
                }
            });
        EXPECT_GT(long_walks, from == 8 ? walks / 200 : walks / 50) << from;
    }
}

// However early or late roulette begins, the mean is the same: the walls of a sphere with albedo rho and
// a point light, whose light of k edges is rho^(k-1) I / (pi R^2) everywhere (closed_form_test.cpp).
TEST_P(Furnace, TheFirstBounceThatRouletteMayEndDoesNotChangeTheMean)
{
    const scenes::Scene scene = transport_test::our_scene("integrating_sphere");
    const auto& wall = scene.spheres.at(0);
    const auto& light = scene.point_lights.at(0);
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[wall.material]).albedo;
    const ref::World world(scene, 24, 24);
    for (const int from : {1, 8}) {
        const auto batches =
            transport_test::estimate(world, GetParam().integrator,
                                     {.batches = 32,
                                      .batch_size = GetParam().samples(12),
                                      .path = {.seed = 39, .max_edges = 6, .roulette_from = from}},
                                     7, by_edges);
        for (int k = 3; k <= 6; ++k)
            for (int channel = 0; channel < 3; ++channel) {
                SCOPED_TRACE(std::to_string(from) + ", " + std::to_string(k) + " edges");
                transport_test::expect_mean(transport_test::measure(batches[static_cast<std::size_t>(k)],
                                                                    {0, 0, 24, 24}, channel),
                                            std::pow(rho[channel], k - 1) * light.intensity[channel] /
                                                (std::numbers::pi * wall.radius * wall.radius),
                                            GetParam().bias(0.05));
            }
    }
}

TEST_P(Furnace, WhiteObjectsCannotBeSeen)
{
    const scenes::Scene scene = transport_test::our_scene("furnace");
    const ref::World world(scene, 24, 16);
    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(16), .path = {.seed = 33}});
    transport_test::expect_picture(
        batches,
        transport_test::known_picture(*scene.camera, 24, 16,
                                      [&](const Line&) { return scene.environment; }),
        GetParam().bias(0.015));
}

// Light of each length by all strategies, weighted, is compared with light of that length from
// emission hits of the path tracer alone, unweighted: a sum over lengths could hide errors that
// cancel.
TEST_P(Furnace, EachLengthBringsWhatWalksAloneFind)
{
    const scenes::Scene scene = transport_test::our_scene("furnace");
    const ref::World world(scene, 24, 16);
    constexpr int longest = 6;
    const ref::PathOptions options{.seed = 34, .max_edges = longest, .roulette = false};
    const auto weighted = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(16), .path = options}, longest + 1, by_edges);
    ref::PathOptions other = options;
    other.seed = 35;
    const auto alone = transport_test::estimate(
        world, ref::trace_path,
        {.batches = 32, .batch_size = GetParam().samples(16), .weighted = false, .path = other},
        longest + 1, [](const Contribution& c) { return c.s == 0 ? edges(c) : -1; });
    double below = 0.0;
    for (std::size_t k = 1; k <= longest; ++k) {
        const auto part = transport_test::measure(weighted[k], {0, 0, 24, 16}, 1);
        transport_test::expect_equal_means(part, transport_test::measure(alone[k], {0, 0, 24, 16}, 1),
                                           GetParam().bias(0.35));
        EXPECT_GT(part.mean, 0.0); // truncated: the picture becomes brighter with each edge
        below += part.mean;
    }
    EXPECT_LT(below, scene.environment->y); // and stays below the sky
}

class GreyFurnace : public Furnace {
protected:
    static constexpr int width = 60;
    static constexpr int height = 30;
    const scenes::Scene scene = transport_test::our_scene("furnace_grey");
    const ref::World world{scene, width, height};
    const Rgb sky = scene.environment.value();
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[scene.spheres.at(0).material]).albedo;
    const double form_factor = 1.0 / 25.0 + 1.0 / 121.0; // of the two other spheres, upper bound

    /// The pixels that show only sphere number `sphere`, with `radiance`.
    [[nodiscard]] transport_test::KnownPicture on_sphere(std::uint32_t sphere, const Rgb& radiance) const
    {
        return transport_test::known_picture(
            *scene.camera, width, height, [&](const Line& line) -> std::optional<Rgb> {
                const auto seen = transport_test::first_seen(scene, line);
                if (!seen || seen->primitive != sphere) return std::nullopt;
                return radiance;
            });
    }

    /// A narrow view of the point (-7, 0, 0): 0.13 wide there, so that the rim is not in view.
    static void look_from_the_left(scenes::Scene& moved)
    {
        auto& camera = *moved.camera;
        camera.eye = {-20.0, 0.0, 0.0};
        camera.backward = {-1.0, 0.0, 0.0};
        camera.right = {0.0, -1.0, 0.0};
        camera.up = {0.0, 0.0, 1.0};
        camera.fov = 0.01;
    }
    void expect_albedo_times_sky(const scenes::Scene& seen, int batch_size, double bias) const
    {
        const ref::World there(seen, 8, 8);
        const auto batches = transport_test::estimate(
            there, GetParam().integrator,
            {.batches = 32, .batch_size = GetParam().samples(batch_size), .path = {.seed = 37}});
        for (int channel = 0; channel < 3; ++channel)
            transport_test::expect_mean(transport_test::measure(batches, {0, 0, 8, 8}, channel),
                                        rho[channel] * sky[channel], GetParam().bias(bias));
    }

    /// The confidence interval of the mean over a sphere must lie between the bounds, and be narrow:
    /// two hundredths, for the fastest integrator.
    void expect_between(const transport_test::Batches& batches, std::uint32_t sphere, const Rgb& low,
                        const Rgb& high) const
    {
        const auto pixels = on_sphere(sphere, high).pixels;
        ASSERT_GT(pixels.size(), 20u);
        for (int channel = 0; channel < 3; ++channel) {
            std::vector<double> values;
            for (const auto& batch : batches)
                values.push_back(transport_test::mean_over(batch, pixels, channel));
            const auto measured = transport_test::measure(values);
            const double half =
                measured.standard_error *
                transport_test::t_quantile(measured.batches - 1.0, transport_test::alpha / 2.0);
            EXPECT_GE(measured.mean + half, low[channel]) << "sphere " << sphere;
            EXPECT_LE(measured.mean - half, high[channel]) << "sphere " << sphere;
            EXPECT_LE(half, GetParam().bias(0.02) * high[channel]) << "the test is too weak";
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Integrators, GreyFurnace, transport_test::integrators(),
                         transport_test::name_of);

TEST_P(GreyFurnace, LightLiesBetweenItsBounds)
{
    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(16), .path = {.seed = 36}}, 2,
        [](const Contribution& c) { return edges(c) <= 2 ? 0 : 1; });
    transport_test::Batches together = batches[0];
    for (std::size_t b = 0; b < together.size(); ++b)
        for (std::size_t i = 0; i < together[b].pixels.size(); ++i)
            together[b].pixels[i] += batches[1][b].pixels[i];

    const Rgb m = rho * sky * (1.0 - form_factor) / (1.0 - rho * form_factor);
    expect_between(batches[0], 0, rho * (1.0 - form_factor) * sky, rho * sky);
    expect_between(together, 0, m, rho * sky);
    expect_between(together, 1, m, sky);
    expect_between(together, 2, m, sky);
}

// At the point (-7, 0, 0), which sees neither of the other spheres, the radiance is known exactly.
TEST_P(GreyFurnace, ConvexAndAloneItReflectsItsAlbedo)
{
    scenes::Scene from_the_left = scene;
    look_from_the_left(from_the_left);
    expect_albedo_times_sky(from_the_left, 32, 0.015);
}

// A light that nothing sees, inside the grey sphere, takes half of the samples and must not take any
// light: the probability of choosing the sky belongs to its density, in the numerator and the
// denominator of every weight.
TEST_P(GreyFurnace, ALightThatNothingSeesTakesNothingAway)
{
    scenes::Scene hidden = scene;
    look_from_the_left(hidden);
    hidden.point_lights.push_back({hidden.spheres.at(0).center, Rgb(100.0)});
    const ref::World left(hidden, 8, 8);
    EXPECT_GT(left.emitters.environment()->probability, 0.2);
    EXPECT_LT(left.emitters.environment()->probability, 0.8);
    expect_albedo_times_sky(hidden, 64, 0.02);
}

// Every bounce on grey multiplies by its albedo, and no other bounce changes the weight of a walk,
// neither on a mirror nor on glass. No walk returns more than the sky, and a pixel that sees the sky
// directly shows exactly the sky.
TEST(FurnaceBySample, AWalkBringsTheSkyTimesAPowerOfTheAlbedo)
{
    const scenes::Scene scene = transport_test::our_scene("furnace_grey");
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[scene.spheres.at(0).material]).albedo;
    const ref::World world(scene, 96, 32);
    std::vector<int> walks_with_bounces(2);
    transport_test::for_every_sample(
        world, ref::trace_path, {.seed = 38, .max_edges = 100, .roulette = false}, 8,
        [&](const Line& line, const std::vector<Contribution>& all) {
            Rgb brought(0.0);
            for (const Contribution& c : all)
                if (c.s == 0) brought += c.value;
            const auto seen = transport_test::first_seen(scene, line);
            const double bounces = std::log(brought.x / scene.environment->x) / std::log(rho.x);
            const double whole = std::round(bounces);
            ASSERT_GE(whole, 0.0);
            for (int i = 0; i < 3; ++i)
                ASSERT_NEAR(brought[i] / ((*scene.environment)[i] * std::pow(rho[i], whole)), 1.0,
                            1e-12);
            if (!seen) {
                ASSERT_EQ(whole, 0.0);
            }
            if (seen && seen->primitive == 0) {
                ASSERT_GE(whole, 1.0);
            }
            ++walks_with_bounces[static_cast<std::size_t>(std::min(whole, 1.0))];
        });
    for (const int walks : walks_with_bounces) EXPECT_GT(walks, 0);
}

// A luminous sphere in the middle of a grey one: every point of the wall sees the lamp under the form
// factor q = (a / R)^2 and the wall under 1 - q. After j bounces: rho L q (rho (1 - q))^j.
TEST_P(Furnace, IntegratingSphereWithALamp)
{
    constexpr int size = 32;
    const scenes::Scene scene = transport_test::our_scene("integrating_sphere_lamp");
    const auto& wall = scene.spheres.at(0);
    const auto& lamp = scene.spheres.at(1);
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[wall.material]).albedo;
    const Rgb radiance = std::get<scenes::Emission>(scene.materials[lamp.material]).radiance;
    const double q = std::pow(lamp.radius / wall.radius, 2);

    const ref::World world(scene, size, size);
    constexpr int longest = 8;
    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(8), .path = {.seed = 39, .max_edges = longest}},
        longest + 1, by_edges);
    for (int k = 1; k <= longest; ++k) {
        const Rgb on_wall =
            k == 1 ? Rgb(0.0) : rho * radiance * q * glm::pow(rho * (1.0 - q), Rgb(k - 2));
        const auto known = transport_test::known_picture(
            *scene.camera, size, size, [&](const Line& line) -> std::optional<Rgb> {
                if (!transport_test::is<scenes::Emission>(scene,
                                                          transport_test::first_seen(scene, line)))
                    return on_wall;
                return k == 1 ? radiance : Rgb(0.0);
            });
        SCOPED_TRACE(std::to_string(k) + " edges");
        // Fewer and fewer walks are so long: for green, the brightest channel, a factor of 0.73 per
        // bounce.
        transport_test::expect_picture(batches[static_cast<std::size_t>(k)], known,
                                       GetParam().bias(k <= 6 ? 0.08 : 0.16), 2);
    }
}

} // namespace
