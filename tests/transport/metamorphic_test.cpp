// The same light in other clothes: how a picture must change when its scene is scaled, moved,
// brightened, reordered or cut into pieces.

#include "ref/transport/path_tracer.h"
#include "tests/transport/changed_scene.h"
#include "tests/transport/estimate.h"
#include "tests/transport/scene_files.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using ref::Rgb;
using ref::Vec3;
using tests::moved;
using tests::scaled;

constexpr int width = 48;
constexpr int height = 32;
const tests::EstimateOptions quick{.batches = 8, .batch_size = 4, .path = {.seed = 21, .max_edges = 6}};

tests::Batches render(const scenes::Scene& scene, const tests::EstimateOptions& options = quick)
{
    const ref::World world(scene, width, height);
    return tests::estimate(world, ref::trace_path, options);
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

/// Each emissive triangle as four, split at the middles of its edges.
scenes::Scene with_lamps_in_pieces(scenes::Scene scene)
{
    std::vector<scenes::Triangle> triangles;
    for (const auto& triangle : scene.triangles) {
        if (!std::holds_alternative<scenes::Emission>(scene.materials[triangle.material])) {
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

/// Pixels of which any channel of any batch differs by more than `tolerance`, relatively.
int different_pixels(const tests::Batches& a, const tests::Batches& b, double tolerance)
{
    int count = 0;
    for (std::size_t batch = 0; batch < a.size(); ++batch)
        for (std::size_t i = 0; i < a[batch].pixels.size(); ++i) {
            const Rgb& p = a[batch].pixels[i];
            const Rgb& q = b[batch].pixels[i];
            for (int channel = 0; channel < 3; ++channel)
                if (std::abs(p[channel] - q[channel]) > tolerance * std::max(p[channel], q[channel])) {
                    ++count;
                    break;
                }
        }
    return count;
}

void expect_same_means(const tests::Batches& a, const tests::Batches& b, double specification)
{
    for (int channel = 0; channel < 3; ++channel)
        tests::expect_equal_means(tests::measure(a, {0, 0, width, height}, channel),
                                  tests::measure(b, {0, 0, width, height}, channel), specification);
}

class Metamorphic : public testing::TestWithParam<const char*> {
protected:
    scenes::Scene scene = tests::our_scene(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Scenes, Metamorphic, testing::Values("cornell_glass", "all_emitters"),
                         [](const auto& name) { return std::string(name.param); });

// By a power of two nothing is rounded differently: not a bit may change. Any absolute constant, be it
// 1e-12, would show.
TEST_P(Metamorphic, ScalingByAPowerOfTwoChangesNoBit)
{
    const tests::Batches original = render(scene);
    EXPECT_EQ(original, render(scaled(scene, 1024.0)));
    EXPECT_EQ(original, render(scaled(scene, 1.0 / 1024.0)));
}

// By other factors every coordinate is rounded anew, by one part in 1e16; a curved surface magnifies the
// change of a path by at most about 2 x distance / radius < 10 per bounce: 1e5 over the five bounces of
// six edges. 1e-8 leaves three digits. A branch taken otherwise (probability 1e-11 a sample) would show
// as a different pixel; over 5e4 samples none is expected.
TEST_P(Metamorphic, ScalingByAnyFactorChangesNothingButRounding)
{
    const tests::Batches original = render(scene);
    EXPECT_EQ(different_pixels(original, render(scaled(scene, 1e3)), 1e-8), 0);
    EXPECT_EQ(different_pixels(original, render(scaled(scene, 1e-3)), 1e-8), 0);
}

// 1e4 diameters away coordinates are known to 1e-12 diameters; times 1e5 as above, 1e-7.
TEST_P(Metamorphic, MovingFarAwayChangesNothingButRounding)
{
    const double diameter = ref::Geometry(scene).diagonal();
    const Vec3 by = diameter * 1e4 * glm::normalize(Vec3(0.6, -0.5, 0.4));
    EXPECT_LE(different_pixels(render(scene), render(moved(scene, by)), 1e-5), 0);
}

TEST_P(Metamorphic, TwiceTheRadianceIsTwiceThePicture)
{
    tests::Batches original = render(scene);
    for (auto& batch : original)
        for (Rgb& pixel : batch.pixels) pixel *= 2.0;
    EXPECT_EQ(original, render(brightened(scene, 2.0)));
}

// Order decides nothing but which random number chooses which emitter: the mean is the same.
TEST_P(Metamorphic, TheOrderOfPrimitivesIsIrrelevant)
{
    scenes::Scene reversed = scene;
    std::reverse(reversed.triangles.begin(), reversed.triangles.end());
    std::reverse(reversed.spheres.begin(), reversed.spheres.end());
    tests::EstimateOptions other = quick;
    other.path.seed = 22;
    other.batches = 96;
    other.batch_size = 10;
    tests::EstimateOptions first = quick;
    first.batches = 96;
    first.batch_size = 10;
    expect_same_means(render(scene, first), render(reversed, other), 0.05);
}

TEST_P(Metamorphic, ALampInFourPiecesShinesAsBefore)
{
    tests::EstimateOptions other = quick;
    other.path.seed = 23;
    other.batches = 96;
    other.batch_size = 10;
    tests::EstimateOptions first = quick;
    first.batches = 96;
    first.batch_size = 10;
    expect_same_means(render(scene, first), render(with_lamps_in_pieces(scene), other), 0.05);
}

} // namespace
