// The searches, against a look at every sample.

#include "explain/names.h"
#include "explain/search.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace {

using explain::Condition;
using explain::Sample;
using explain::Strategy;

constexpr int columns = 30;
constexpr int rows = 20;
constexpr std::uint32_t samples = 5;

struct Room {
    scenes::Scene scene = transport_test::our_scene("cornell_glass");
    ref::World world{scene, columns, rows};
    images::RenderOptions options{.integrator = images::Integrator::bdpt, .seed = 3, .max_edges = 6};

    [[nodiscard]] Sample sample(std::uint32_t pixel, std::uint32_t number) const
    {
        return explain::explain_sample(world, options.integrator, ref::path_options(options),
                                       {options.seed, pixel, number});
    }

    [[nodiscard]] std::optional<explain::Found> first(const std::string& text,
                                                      explain::Range range = {samples}) const
    {
        bool stopped = false;
        return explain::find_first(world, options, range, Condition(text), {}, stopped);
    }
};

/// Whether the sample has a strategy like this, by the meaning of the words.
using Like = bool (*)(const Strategy&);

void expect_first(const Room& room, const std::string& text, Like like)
{
    for (std::uint32_t number = 0; number < samples; ++number)
        for (std::uint32_t pixel = 0; pixel < columns * rows; ++pixel) {
            const Sample sample = room.sample(pixel, number);
            const auto strategy = std::ranges::find_if(sample.strategies, like);
            if (strategy == sample.strategies.end()) continue;
            const auto found = room.first(text);
            ASSERT_TRUE(found) << text;
            EXPECT_EQ(found->id.pixel, pixel) << text;
            EXPECT_EQ(found->id.sample, number) << text;
            EXPECT_EQ(found->s, strategy->s) << text;
            EXPECT_EQ(found->t, strategy->t) << text;
            return;
        }
    ADD_FAILURE() << "no sample is like this: " << text;
}

TEST(ExplainSearch, FindsTheFirstOfAKind)
{
    const Room room;
    expect_first(room, "s=2,t=2,weight>0.5", [](const Strategy& a) {
        return a.s == 2 && a.t == 2 && a.made && a.made->weight > 0.5;
    });
    expect_first(room, "s=0,weight>=0.001,edges<6", [](const Strategy& a) {
        return a.s == 0 && a.t <= 6 && a.made && a.made->weight >= 0.001;
    });
    expect_first(room, "s!=1,adds>0.2,value<=3,t<=3", [](const Strategy& a) {
        return a.s != 1 && a.t <= 3 && a.made && ref::max_component(a.contribution()) > 0.2 &&
               ref::max_component(a.made->value) <= 3.0;
    });
    expect_first(room, "family=inner_connection,obstacle=blocked,s=3", [](const Strategy& a) {
        return a.s == 3 && a.t > 1 && a.obstacle == explain::Obstacle::blocked;
    });
    EXPECT_FALSE(room.first("weight>1"));
}

TEST(ExplainSearch, SearchesOnePixelAlone)
{
    const Room room;
    const auto found = room.first("s=1,t=2", {samples, 315});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->id.pixel, 315u);
}

TEST(ExplainSearch, RefusesConditionsThatMeanNothing)
{
    for (const char* text :
         {"", "s", "s=2,", "s==2", "s=two", "s=", "q=2", "weight>0.5x", "family=glass", "obstacle<none",
          "obstacle=nothing", "=2", "s=2;t=3", "weight=>1"})
        EXPECT_THROW(Condition{text}, std::invalid_argument) << text;
}

TEST(ExplainSearch, FindsTheSampleThatRaisesItsPixelMost)
{
    const Room room;
    bool stopped = false;
    const auto firefly = explain::find_firefly(room.world, room.options, samples, 2, {}, stopped);
    ASSERT_TRUE(firefly);
    const auto luminance = [](const ref::Rgb& v) { return 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z; };
    // What each number of samples adds to each pixel, splats included, and the largest contribution.
    std::vector<std::vector<double>> adds(samples, std::vector<double>(columns * rows, 0.0));
    double largest = 0.0;
    ref::SampleId of_largest{};
    for (std::uint32_t number = 0; number < samples; ++number)
        for (std::uint32_t pixel = 0; pixel < columns * rows; ++pixel)
            for (const Strategy& strategy : room.sample(pixel, number).strategies) {
                if (!strategy.made) continue;
                const double added = luminance(strategy.contribution());
                adds[number][strategy.made->pixel] += added;
                if (number != firefly->sample || strategy.made->pixel != firefly->pixel ||
                    added <= largest)
                    continue;
                largest = added;
                of_largest = {room.options.seed, pixel, number};
            }
    const auto raise = [&](std::uint32_t pixel, std::uint32_t number) {
        double others = 0.0;
        for (std::uint32_t i = 0; i < samples; ++i) others += i == number ? 0.0 : adds[i][pixel];
        return (others + adds[number][pixel]) / samples - others / (samples - 1);
    };
    for (std::uint32_t number = 0; number < samples; ++number)
        for (std::uint32_t pixel = 0; pixel < columns * rows; ++pixel)
            EXPECT_LE(raise(pixel, number), raise(firefly->pixel, firefly->sample) + 1e-12);
    // It is not the brightest pixel: there, every sample sees the lamp.
    std::vector<double> mean(columns * rows, 0.0);
    for (const auto& of_number : adds)
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += of_number[i] / samples;
    EXPECT_LT(firefly->mean, *std::ranges::max_element(mean));
    EXPECT_EQ(firefly->cause.id.pixel, of_largest.pixel);
    EXPECT_DOUBLE_EQ(firefly->adds, largest);
    EXPECT_NEAR(firefly->mean - firefly->others, raise(firefly->pixel, firefly->sample), 1e-12);
}

} // namespace
