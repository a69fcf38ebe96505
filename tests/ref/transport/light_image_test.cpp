// The place of splats on the film, and their division.

#include "ref/transport/bdpt.h"
#include "ref/transport/renderer.h"
#include "tests/ref/transport/estimate.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using ref::Contribution;
using ref::Rgb;
using std::numbers::pi;

class Splats : public testing::TestWithParam<ref::Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Splats,
                         testing::Values(&ref::trace_bidirectionally, &ref::trace_light),
                         [](const auto& name) {
                             return name.param == &ref::trace_light ? "light" : "bdpt";
                         });

// The mean radiance of a picture does not depend on its number of pixels; nor does that of a part that
// another aspect ratio shows as well. Splats divided by the wrong number fail here.
TEST_P(Splats, HaveTheSameScaleInEverySizeAndShape) // map: splat
{
    const scenes::Scene scene = transport_test::our_scene("cornell_diffuse"); // horizontal field of view
    const auto part = [&](int width, int height, int batch_size, const transport_test::Region& region) {
        const ref::World world(scene, width, height);
        const auto batches = transport_test::estimate(
            world, GetParam(),
            {.batches = 32, .batch_size = batch_size, .path = {.seed = 13, .max_edges = 3}});
        return transport_test::measure(batches, region, 0);
    };
    const auto wide = part(24, 16, 12, {0, 4, 24, 12});
    const auto small = part(6, 4, 200, {0, 1, 6, 3});
    const auto strip = part(24, 8, 24, {0, 0, 24, 8});   // the middle half of the picture
    const auto tall = part(12, 24, 16, {0, 10, 12, 14}); // 12 x 4 in the middle of it
    transport_test::expect_equal_means(wide, small, 0.06);
    transport_test::expect_equal_means(wide, strip, 0.06);
    transport_test::expect_equal_means(strip, tall, 0.06);
}

// Every pixel, up to the edges: a constant picture, of four edges in the integrating sphere, has no
// dark border.
TEST(LightImage, ReachesTheEdgesOfTheFilm)
{
    const scenes::Scene scene = transport_test::our_scene("integrating_sphere");
    constexpr int n = 16;
    const ref::World world(scene, n, n);
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[scene.spheres[0].material]).albedo;
    const double expected = std::pow(rho.x, 3) * scene.point_lights[0].intensity.x / pi;
    const auto batches =
        transport_test::estimate(
            world, ref::trace_light,
            {.batches = 32, .batch_size = 48, .weighted = false, .path = {.max_edges = 4}}, 1,
            [](const Contribution& c) { return c.s == 4 ? 0 : -1; })
            .front();
    for (const transport_test::Region& rim :
         {transport_test::Region{0, 0, n, 1}, {0, n - 1, n, n}, {0, 0, 1, n}, {n - 1, 0, n, n}})
        transport_test::expect_mean(transport_test::measure(batches, rim, 0), expected, 0.2);
}

// A film is the same to the last bit for any number of threads, and whether it was rendered at once or
// in two parts: splats cross tiles, and 40 x 24 pixels are six tiles.
TEST_P(Splats, FallInTheSameOrderWhateverTheThreads)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_glass");
    const ref::World world(scene, 40, 24);
    const auto film = [&](unsigned threads, std::uint64_t first_part) {
        images::Film result(40, 24);
        const auto renderer =
            ref::renderer(world, GetParam(), {.seed = 2, .max_edges = 5, .batch_size = 1}, threads);
        if (first_part > 0) {
            EXPECT_TRUE(images::fill(result, first_part, *renderer));
            result = images::Film(40, 24, result.range(), result.blocks());
        }
        EXPECT_TRUE(images::fill(result, 4, *renderer));
        return result;
    };
    const images::Film one = film(1, 0);
    EXPECT_TRUE(one == film(2, 0));
    EXPECT_TRUE(one == film(5, 0));
    EXPECT_TRUE(one == film(3, 1));
    EXPECT_FALSE(one.mean() == images::Image(40, 24));
}

// The picture of the renderer equals a plain sum over the contributions, up to the order of summation.
TEST_P(Splats, AreDividedBySamplesPerPixelOnce)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_diffuse");
    const ref::World world(scene, 20, 12);
    images::Film film(20, 12);
    const ref::PathOptions options{.seed = 6, .max_edges = 4};
    ASSERT_TRUE(images::fill(
        film, 2, *ref::renderer(world, GetParam(), {.seed = 6, .max_edges = 4, .batch_size = 3}, 2)));
    images::Image sum(20, 12);
    std::vector<Contribution> out;
    for (std::uint32_t pixel = 0; pixel < 20 * 12; ++pixel)
        for (std::uint32_t i = 0; i < 6; ++i) GetParam()(world, options, {6, pixel, i}, out);
    for (const Contribution& c : out) sum.pixels[c.pixel] += c.weight * c.value / 6.0;
    const images::Image mean = film.mean();
    for (std::size_t i = 0; i < sum.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(mean.pixels[i][channel], sum.pixels[i][channel], 1e-12 * sum.pixels[i][channel]);
}

} // namespace
