// Properties of every scene in the repository: light is finite, never negative, and additive.

#include "tests/ref/transport/integrators.h"
#include "tests/ref/transport/known_light.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

namespace {

using ref::Contribution;
using ref::Rgb;

class EveryScene : public transport_test::OfEveryIntegrator {};

INSTANTIATE_TEST_SUITE_P(Integrators, EveryScene, transport_test::integrators(),
                         transport_test::name_of);
INSTANTIATE_TEST_SUITE_P(LightTracer, EveryScene, transport_test::light_tracer(),
                         transport_test::name_of);

TEST_P(EveryScene, HasNoSampleThatIsNegativeOrNotANumber)
{
    const auto files = transport_test::our_scene_files();
    EXPECT_GE(files.size(), 20u);
    for (const auto& file : files) {
        const scenes::Scene scene = scenes::read_scene(file);
        SCOPED_TRACE(scene.name);
        const ref::World world(scene, 48, 32);
        // As many samples as the search through all primitives allows; at least one in some of the
        // pixels.
        const auto affordable = static_cast<int>(1'000'000 / (scenes::primitive_count(scene) + 180));
        std::vector<Contribution> contributions;
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(GetParam().samples(affordable)); ++i) {
            const std::uint32_t pixel = i * 613 % (48 * 32); // 613 is prime: spreads over the picture
            contributions.clear();
            GetParam().integrator(world, {.seed = 71}, {71, pixel, i / (48 * 32)}, contributions);
            for (const Contribution& c : contributions) {
                for (int channel = 0; channel < 3; ++channel) {
                    ASSERT_TRUE(std::isfinite(c.value[channel])) << "pixel " << pixel;
                    ASSERT_GE(c.value[channel], 0.0) << "pixel " << pixel;
                }
                ASSERT_GE(c.weight, 0.0);
                ASSERT_LE(c.weight, 1.0);
                ASSERT_LT(c.pixel, 48u * 32u);
                ASSERT_GE(c.s, 0);
                ASSERT_GE(c.t, 1);
                ASSERT_GE(edges(c), 1);
            }
        }
    }
}

/// The scene with one kind of light only. Other emissive surfaces are still there, but black.
scenes::Scene with_only(scenes::Scene scene, int kind)
{
    for (auto& triangle : scene.triangles)
        if (kind != 0 && std::holds_alternative<scenes::Emission>(scene.materials[triangle.material])) {
            scene.materials.emplace_back(scenes::Emission{Rgb(0.0)});
            triangle.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
        }
    for (auto& sphere : scene.spheres)
        if (kind != 1 && std::holds_alternative<scenes::Emission>(scene.materials[sphere.material])) {
            scene.materials.emplace_back(scenes::Emission{Rgb(0.0)});
            sphere.material = static_cast<std::uint32_t>(scene.materials.size() - 1);
        }
    if (kind != 2) scene.point_lights.clear();
    if (kind != 3) scene.directional_lights.clear();
    if (kind != 4) scene.spot_lights.clear();
    if (kind != 5) scene.environment.reset();
    return scene;
}

// Light is linear: the picture of six kinds of emitters is the sum of those of each kind. This fails
// if an emitter is chosen with another probability than the one divided by, or weighted with the
// density of another emitter.
TEST_P(EveryScene, ThePictureOfAllEmittersIsTheSumOfSix)
{
    constexpr int width = 36;
    constexpr int height = 24;
    const scenes::Scene scene = transport_test::our_scene("all_emitters");
    const auto render = [&](const scenes::Scene& lit, std::uint64_t seed, int batch_size) {
        const ref::World world(lit, width, height);
        return transport_test::estimate(world, GetParam().integrator,
                                        {.batches = 32,
                                         .batch_size = GetParam().samples(batch_size),
                                         .path = {.seed = seed, .max_edges = 4, .roulette = false}});
    };
    const transport_test::Batches together = render(scene, 72, 16);
    transport_test::Batches sum(together.size(), images::Image(width, height));
    for (int kind = 0; kind < 6; ++kind) {
        const transport_test::Batches alone =
            render(with_only(scene, kind), 73 + static_cast<unsigned>(kind), 3);
        EXPECT_NE(alone.front(), images::Image(width, height)) << "nothing lit by kind " << kind;
        for (std::size_t b = 0; b < sum.size(); ++b)
            for (std::size_t i = 0; i < sum[b].pixels.size(); ++i)
                sum[b].pixels[i] += alone[b].pixels[i];
    }
    for (const transport_test::Region& region : {transport_test::Region{0, 0, width, height},
                                                 {0, 0, width / 2, height / 2},
                                                 {width / 2, 0, width, height / 2},
                                                 {0, height / 2, width / 2, height},
                                                 {width / 2, height / 2, width, height}})
        for (int channel = 0; channel < 3; ++channel)
            transport_test::expect_equal_means(
                transport_test::measure(together, region, channel),
                transport_test::measure(sum, region, channel),
                GetParam().bias(region.x1 - region.x0 == width ? 0.12 : 0.35));
}

} // namespace
