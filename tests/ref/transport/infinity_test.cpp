// The sky, which eye walks hit and light walks choose.

#include "ref/transport/bdpt.h"
#include "tests/ref/transport/estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using ref::Contribution;
using ref::Rgb;
using ref::Vec3;
using std::numbers::pi;

// An empty scene has no extent that light from infinity could reach: the eye sees the sky by hitting
// it, and no light walk starts there.
TEST(Infinity, AnEmptySceneShowsTheSky)
{
    scenes::Scene scene;
    scene.environment = Rgb(0.9, 0.6, 0.3);
    scene.camera = scenes::Camera{
        Vec3(0.0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), scenes::FovAxis::horizontal, 1.5};
    const ref::World world(scene, 12, 8);
    std::vector<Contribution> out;
    for (std::uint32_t i = 0; i < 96; ++i)
        trace_bidirectionally(world, {.max_edges = 3}, {0, i, 0}, out);
    ASSERT_EQ(out.size(), 96u);
    for (const Contribution& c : out) EXPECT_EQ(c.weight * c.value, *scene.environment);
}

// With a black ball behind the eye the sky can also be chosen, and seen as a light image of one
// vertex. A hit has the density 1 / (A c^3), a choice 1 / (4 pi). For a picture of 1.86 sr found by
// both strategies, every weight is known: c^-3 / (c^-3 + A / (4 pi)).
TEST(Infinity, TheSkyIsHitAndChosenWithTheirShares) // map: balance
{
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{Rgb(0.0)}};
    scene.material_names = {"black"};
    scene.spheres.push_back({Vec3(0, 0, 5), 1.0, 0});
    scene.environment = Rgb(0.9, 0.6, 0.3);
    scene.camera = scenes::Camera{
        Vec3(0.0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), scenes::FovAxis::horizontal, 1.5};
    const ref::World world(scene, 12, 8);
    const double area = std::pow(2.0 * std::tan(0.75), 2) * 8 / 12;
    std::vector<Contribution> out;
    for (std::uint32_t i = 0; i < 96 * 16; ++i) {
        const ref::SampleId id{0, i % 96, i / 96};
        out.clear();
        trace_bidirectionally(world, {.max_edges = 3}, id, out);
        ASSERT_FALSE(out.empty());
        EXPECT_EQ(out[0].s, 0);
        const double c = -camera_ray(world, id).direction.z;
        EXPECT_NEAR(out[0].weight, 1.0 / (1.0 + area * c * c * c / (4.0 * pi)), 1e-14);
    }
    const auto both = transport_test::estimate(
        world, ref::trace_bidirectionally, {.batches = 32, .batch_size = 256, .path = {.max_edges = 3}});
    for (int channel = 0; channel < 3; ++channel)
        transport_test::expect_mean(transport_test::measure(both, {0, 0, 12, 8}, channel),
                                    (*scene.environment)[channel], 0.02);
}

} // namespace
