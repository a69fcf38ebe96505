#include "ref/transport/renderer.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace {

using ref::Rgb;

constexpr int width = 20;
constexpr int height = 18; // more than one tile
constexpr int max_edges = 4;
constexpr std::uint32_t batch_size = 4;

images::StrategySums rendered(bool weighted, unsigned threads, images::Film& film)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_glass");
    images::RenderOptions options{.seed = 4, .max_edges = max_edges, .batch_size = batch_size};
    options.strategies =
        weighted ? images::StrategyPictures::weighted : images::StrategyPictures::unweighted;
    const auto renderer = ref::renderer(scene, width, height, options, threads);
    images::StrategySums sums;
    images::fill(film, 3, *renderer, {},
                 [&](const images::Batch& batch) { sums.add(batch.strategies); });
    return sums;
}

// Both are sums of the same terms in different orders: about 15 strategies, 12 samples, and at most 20
// splats per pixel, all positive. 1e3 roundings are far more than occur.
TEST(Strategies, WeightedPicturesAddUpToTheWhole)
{
    images::Film film(width, height);
    images::Image sum(width, height);
    for (const auto& [strategy, image] : rendered(true, 2, film).means(batch_size))
        for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i];
    const images::Image mean = film.mean();
    for (std::size_t i = 0; i < sum.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(sum.pixels[i][channel], mean.pixels[i][channel],
                        1e3 * 0x1p-53 * mean.pixels[i][channel]);
}

TEST(Strategies, DoNotDependOnTheNumberOfThreads)
{
    images::Film film(width, height);
    images::Film again(width, height);
    EXPECT_EQ(rendered(false, 1, film).means(batch_size), rendered(false, 3, again).means(batch_size));
}

// Directly seen light: each of the two strategies finds all of it alone; together their weights must
// add up to 1.
TEST(Strategies, UnweightedPicturesShowTheirStrategyAlone)
{
    images::Film film(width, height);
    images::Film again(width, height);
    const auto alone = rendered(false, 2, film).means(batch_size);
    const auto shared = rendered(true, 2, again).means(batch_size);
    const auto brightest = [](const images::Image& image) {
        double most = 0.0;
        for (const Rgb& pixel : image.pixels) most = std::max(most, pixel.x);
        return most;
    };
    ASSERT_TRUE(alone.contains({0, 2}) && alone.contains({1, 1}));
    EXPECT_GT(brightest(alone.at({0, 2})), brightest(shared.at({0, 2})));
    EXPECT_EQ(film, again); // the picture itself is weighted either way
    EXPECT_FALSE(alone.contains({max_edges + 1, 1}));
}

TEST(Strategies, RefusesLengthsThatWouldFillTheMemory)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_glass");
    const auto renderer = [&](int most_edges) {
        return ref::renderer(
            scene, 4, 4, {.max_edges = most_edges, .strategies = images::StrategyPictures::weighted});
    };
    EXPECT_THROW((void)renderer(images::unlimited_edges), std::invalid_argument);
    EXPECT_THROW((void)renderer(0), std::invalid_argument);
    EXPECT_NO_THROW((void)renderer(images::most_edges_of_strategies));
}

} // namespace
