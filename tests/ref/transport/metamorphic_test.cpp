// Metamorphic tests: how a picture must change when its scene is scaled, moved, brightened, reordered
// or divided into pieces.

#include "tests/ref/transport/changed_scene.h"
#include "tests/ref/transport/contributions.h"
#include "tests/ref/transport/estimate.h"
#include "tests/ref/transport/integrators.h"
#include "tests/ref/transport/rounded_room.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace {

using ref::Contribution;
using ref::Rgb;
using ref::Vec3;
using transport_test::different;
using transport_test::moved;
using transport_test::scaled;

bool emits(const scenes::Scene& scene, std::uint32_t material)
{
    return std::holds_alternative<scenes::Emission>(scene.materials[material]);
}

/// All light times `factor`.
scenes::Scene brightened(scenes::Scene scene, double factor)
{
    for (auto& material : scene.materials)
        if (auto* emission = std::get_if<scenes::Emission>(&material)) emission->radiance *= factor;
    for (auto& light : scene.point_lights) light.intensity *= factor;
    for (auto& light : scene.spot_lights) light.intensity *= factor;
    for (auto& light : scene.directional_lights) light.irradiance *= factor;
    if (scene.environment) *scene.environment *= factor;
    return scene;
}

/// All primitives in reverse order; with `lamps_stay`, the lamps come first and in their old order.
scenes::Scene reversed(scenes::Scene scene, bool lamps_stay)
{
    const auto reverse = [&](auto& primitives) {
        std::ranges::reverse(primitives);
        if (!lamps_stay) return;
        const auto dark =
            std::stable_partition(primitives.begin(), primitives.end(), [&](const auto& primitive) {
                return emits(scene, primitive.material);
            });
        std::reverse(primitives.begin(), dark);
    };
    reverse(scene.triangles);
    reverse(scene.spheres);
    return scene;
}

/// Splits each emissive triangle into four, at the middles of its edges.
scenes::Scene with_lamps_in_pieces(scenes::Scene scene)
{
    std::vector<scenes::Triangle> triangles;
    for (const auto& triangle : scene.triangles) {
        if (!emits(scene, triangle.material)) {
            triangles.push_back(triangle);
            continue;
        }
        const auto& [a, b, c] = triangle.vertices;
        const Vec3 ab = (a + b) / 2.0;
        const Vec3 bc = (b + c) / 2.0;
        const Vec3 ca = (c + a) / 2.0;
        for (const auto& piece : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}})
            triangles.push_back({piece, triangle.material});
    }
    scene.triangles = triangles;
    return scene;
}

class Metamorphic
    : public testing::TestWithParam<std::tuple<const char*, transport_test::NamedIntegrator>> {
protected:
    transport_test::NamedIntegrator named = std::get<1>(GetParam());
    scenes::Scene scene = transport_test::our_scene(std::get<0>(GetParam()));

    [[nodiscard]] std::vector<Contribution> samples(const scenes::Scene& of) const
    {
        return transport_test::contributions(of, named.integrator, 6,
                                             static_cast<std::uint32_t>(named.samples(16000)));
    }

    /// Tests that the means of the whole picture are equal. The cost is about the same for every
    /// integrator.
    void expect_same_picture(const scenes::Scene& changed) const
    {
        const auto render = [&](const scenes::Scene& of, std::uint64_t seed) {
            const ref::World world(of, 24, 16);
            return transport_test::estimate(
                world, named.integrator,
                {.batches = 64, .batch_size = named.samples(8), .path = {.seed = seed, .max_edges = 6}});
        };
        const transport_test::Batches a = render(scene, 21);
        const transport_test::Batches b = render(changed, 22);
        for (int channel = 0; channel < 3; ++channel)
            transport_test::expect_equal_means(transport_test::measure(a, {0, 0, 24, 16}, channel),
                                               transport_test::measure(b, {0, 0, 24, 16}, channel),
                                               named.bias(0.15));
    }
};

std::string scene_and_integrator(const testing::TestParamInfo<Metamorphic::ParamType>& info)
{
    return std::string(std::get<0>(info.param)) + '_' + std::get<1>(info.param).name;
}

INSTANTIATE_TEST_SUITE_P(Integrators, Metamorphic,
                         testing::Combine(testing::Values("cornell_glass", "all_emitters"),
                                          transport_test::integrators()),
                         scene_and_integrator);
INSTANTIATE_TEST_SUITE_P(LightTracer, Metamorphic,
                         testing::Combine(testing::Values("cornell_glass", "all_emitters"),
                                          transport_test::light_tracer()),
                         scene_and_integrator);

// Scaling by a power of two changes no rounding, so no bit may change. Any absolute constant, even
// 1e-12, would change bits; so would a product of four lengths, beyond 2^256, or of the densities of
// many vertices.
TEST_P(Metamorphic, ScalingByAPowerOfTwoChangesNoBit)
{
    const auto original = samples(scene);
    ASSERT_FALSE(original.empty());
    for (const int exponent : {-320, -10, 10, 320})
        EXPECT_EQ(different(original, samples(scaled(scene, std::ldexp(1.0, exponent))), 0.0), 0U)
            << "2^" << exponent;
}

// A path of 50 edges has 51 densities, each per area: at this scale their product would be 2^51200.
TEST(Metamorphic, LongPathsWeighTheSameAtAnyScale)
{
    for (const bool lamp : {false, true}) {
        scenes::Scene room = transport_test::rounded_room(lamp);
        for (scenes::Material& material : room.materials)
            if (auto* matte = std::get_if<scenes::Lambertian>(&material)) matte->albedo = Rgb(0.98);
        const auto long_paths = [](const scenes::Scene& of) {
            return transport_test::contributions(of, ref::trace_bidirectionally, 50, 30);
        };
        const auto original = long_paths(room);
        EXPECT_GT(std::ranges::count_if(
                      original, [](const Contribution& c) { return edges(c) > 30 && c.weight > 0.0; }),
                  100);
        for (const int exponent : {-320, 320})
            EXPECT_EQ(different(original, long_paths(scaled(room, std::ldexp(1.0, exponent))), 0.0), 0U)
                << "2^" << exponent;
    }
}

// With other factors every coordinate is rounded anew, by one part in 1e16. A curved surface magnifies
// the change of a path by at most about 2 x distance / radius < 10 per bounce: 1e5 over the five
// bounces of six edges, which gives 1e-11. A path may consist of two walks, and its weight is a
// quotient of products of all its factors: 1e-7 leaves four digits of margin. If a sample took another
// branch (probability 1e-11 per sample), the number of contributions would differ; over 1e4 samples
// none is expected.
TEST_P(Metamorphic, ScalingByAnyFactorChangesNothingButRounding)
{
    const auto original = samples(scene);
    EXPECT_EQ(different(original, samples(scaled(scene, 1e3)), 1e-7), 0U);
    EXPECT_EQ(different(original, samples(scaled(scene, 1e-3)), 1e-7), 0U);
}

// At a distance of 1e4 diameters coordinates are known to 1e-12 diameters; times 1e5 as above, this
// gives 1e-7. In corners, where the two vertices of a connection are close, it is magnified once more,
// by (diameter / d): one in a thousand of the bidirectional contributions may differ by more than
// 1e-5.
TEST_P(Metamorphic, MovingFarAwayChangesNothingButRounding)
{
    const double diameter = ref::Geometry(scene).diagonal();
    const Vec3 by = diameter * 1e4 * glm::normalize(Vec3(0.6, -0.5, 0.4));
    const auto original = samples(scene);
    EXPECT_LE(different(original, samples(moved(scene, by)), 1e-5),
              named.integrator == ref::trace_bidirectionally ? original.size() / 1000 : 0U);
}

TEST_P(Metamorphic, TwiceTheRadianceIsTwiceThePicture)
{
    auto original = samples(scene);
    for (Contribution& c : original) c.value *= 2.0;
    EXPECT_EQ(different(original, samples(brightened(scene, 2.0)), 0.0), 0U);
}

// The order of primitives that do not emit changes nothing, not even between surfaces that share an
// edge: a ray is tested against each of them independently.
TEST_P(Metamorphic, TheOrderOfDarkPrimitivesChangesNoBit)
{
    EXPECT_EQ(different(samples(scene), samples(reversed(scene, true)), 0.0), 0U);
}

// The order of lamps decides which random number chooses which lamp: only the mean is the same.
TEST_P(Metamorphic, TheOrderOfLampsIsIrrelevant)
{
    expect_same_picture(reversed(scene, false));
}

TEST_P(Metamorphic, ALampInFourPiecesShinesAsBefore)
{
    expect_same_picture(with_lamps_in_pieces(scene));
}

} // namespace
