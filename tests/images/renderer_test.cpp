// The interface Renderer alone: a renderer of ten lines, and the results of the loops that call it.

#include "images/renderer.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace {

using images::Batch;
using images::Image;
using images::Rgb;

/// Pixel i of batch n is n + i / 10. Reports progress after each batch, and asks before each whether to
/// stop.
class Counting : public images::Renderer {
public:
    std::uint64_t lacking = 0; // contributions that each batch lacks

private:
    std::optional<Batch> make_batch(std::uint64_t number, const images::Monitor& monitor) override
    {
        if (monitor.stop && monitor.stop()) return std::nullopt;
        Batch batch{Image(3, 2), {}, {lacking, 4, 1, 2}};
        for (std::size_t i = 0; i < batch.mean.pixels.size(); ++i)
            batch.mean.pixels[i] = Rgb(static_cast<double>(number) + 0.1 * static_cast<double>(i));
        batch.strategies[{0, 2}] = batch.mean;
        if (monitor.progress) monitor.progress(static_cast<double>(number) + 1);
        return batch;
    }
};

TEST(Fill, AddsTheBatchesThatTheFilmLacksInOrder)
{
    Counting renderer;
    images::Film film(3, 2);
    std::vector<double> first_pixels;
    std::vector<std::uint64_t> held;
    const auto added = [&](const Batch& batch) {
        first_pixels.push_back(batch.mean.pixels[0].x);
        held.push_back(film.batches());
    };
    EXPECT_TRUE(images::fill(film, 2, renderer, {}, added));
    EXPECT_TRUE(images::fill(film, 5, renderer, {}, added));
    EXPECT_TRUE(images::fill(film, 5, renderer, {}, added)); // the film has them already
    EXPECT_EQ(first_pixels, (std::vector<double>{0, 1, 2, 3, 4}));
    EXPECT_EQ(held, (std::vector<std::uint64_t>{1, 2, 3, 4, 5}));
    EXPECT_DOUBLE_EQ(film.mean().pixels[3].x, 2.3);
}

TEST(Fill, KeepsWholeBatchesWhereItIsStopped)
{
    Counting renderer;
    images::Film film(3, 2);
    int asked = 0;
    double done = 0;
    const images::Monitor monitor{[&](double d) { done = d; }, [&] { return ++asked > 3; }};
    EXPECT_FALSE(images::fill(film, 9, renderer, monitor));
    EXPECT_EQ(film.batches(), 3u);
    EXPECT_EQ(done, 3.0);
}

TEST(Fill, RefusesAFilmOfAnotherSize)
{
    Counting renderer;
    images::Film film(2, 3);
    EXPECT_THROW(images::fill(film, 1, renderer), std::invalid_argument);
}

TEST(RenderBatches, GoesThroughTheRange)
{
    Counting renderer;
    std::vector<double> seen;
    const auto note = [&](const Batch& batch) { seen.push_back(batch.mean.pixels[0].x); };
    EXPECT_TRUE(images::render_batches(renderer, 7, 9, {}, note));
    EXPECT_TRUE(images::render_batches(renderer, 9, 9, {}, note)); // no batch
    EXPECT_EQ(seen, (std::vector<double>{7, 8}));
}

// No renderer can drop contributions without a report: the interface itself checks this.
TEST(Renderer, ReportsWhatIsNotFiniteOrThrows)
{
    Counting renderer;
    renderer.lacking = 2;
    EXPECT_THROW((void)renderer.render_batch(0), std::runtime_error);
    images::Dropped dropped;
    const images::Monitor monitor{{}, {}, [&](const images::Dropped& d) { dropped += d; }};
    EXPECT_TRUE(renderer.render_batch(0, monitor));
    EXPECT_TRUE(renderer.render_batch(1, monitor));
    EXPECT_EQ(dropped.count, 4u);
    EXPECT_EQ(dropped.pixel, 4u);
}

TEST(StrategySums, AreDividedByAllSamplesAndLeaveOutWhatIsBlack)
{
    images::StrategySums sums;
    Image one(2, 1);
    one.pixels = {Rgb(1, 2, 3), Rgb(0)};
    sums.add({{{0, 2}, one}, {{1, 1}, Image(2, 1)}});
    sums.add({{{0, 2}, one}, {{2, 1}, one}});
    const images::Strategies means = sums.means(4);
    ASSERT_EQ(means.size(), 2u);
    EXPECT_EQ(means.at({0, 2}).pixels[0], Rgb(0.25, 0.5, 0.75));
    EXPECT_EQ(means.at({2, 1}).pixels[0], Rgb(0.125, 0.25, 0.375)); // of all 8 samples
    EXPECT_EQ(images::layer_name(2, 1), "s2t1");
}

} // namespace
