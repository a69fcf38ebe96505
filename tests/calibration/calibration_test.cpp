// The short version of `./run calibrate`: the rates that docs/comparison.md states, with fewer trials.

#include "tests/calibration/experiments.h"

#include <gtest/gtest.h>

#include <thread>

namespace {

using namespace calibration;

Plan small_plan(int size, int goldens, int trials)
{
    Plan plan;
    plan.size = size;
    plan.goldens = goldens;
    plan.trials = trials;
    plan.threads = std::min(2U, std::max(1U, std::thread::hardware_concurrency()));
    return plan;
}

/// The seeds are fixed, so the outcome is, too. The level states how unlikely a failure is.
class FalseAlarm : public ::testing::TestWithParam<Noise> {};

TEST_P(FalseAlarm, IsAsRareAsTheLevelsSayWhateverTheTailOfTheNoise)
{
    const FalseAlarms result = measure_false_alarms(GetParam(), small_plan(32, 2, 6));
    EXPECT_EQ(result.failed.hits, 0u);
    // The probability of a suspicion is at most 5%, so that of 4 or more in 12 trials is at most 2e-3.
    EXPECT_LT(result.suspected.hits, 4u);
    // Tests on one picture depend on each other, so no binomial limit applies: three times the level.
    EXPECT_LT(static_cast<double>(result.below_1e3.hits),
              3e-3 * static_cast<double>(result.below_1e3.trials));
    EXPECT_GT(result.below_1e3.trials, 10'000u);
}

INSTANTIATE_TEST_SUITE_P(Noises, FalseAlarm, ::testing::ValuesIn(noises), [](const auto& noise) {
    std::string text = name(noise.param);
    std::erase_if(text, [](char c) { return c == ' ' || c == '.'; });
    return text;
});

/// A single picture, whose noise must be estimated, with fewer samples than its golden or with many
/// more. Pictures compared with one golden share the error of that golden, so each has its own golden.
TEST_P(FalseAlarm, OfASinglePictureIsRareHoweverManySamplesItHas)
{
    const SimulatedRenderer renderer(32, GetParam());
    for (const std::uint64_t batches : {16u, 128u, 1024u}) {
        int suspected = 0;
        for (std::uint64_t trial = 0; trial < 16; ++trial) {
            golden::GoldenMaker maker(32, 32, 64);
            for (std::uint64_t batch = 0; batch < 64 + 128; ++batch)
                maker.add_batch(renderer.render(1000 + trial, batch));
            images::Film film(32, 32);
            for (std::uint64_t batch = 0; batch < batches; ++batch)
                film.add_batch(renderer.render(2000 + trial, batch));
            const golden::CompareOptions options;
            const golden::Comparison comparison =
                golden::compare_picture(maker.golden({{"batch_size", "4"}}), film.mean(),
                                        4.0 * static_cast<double>(batches), options);
            suspected += comparison.p < options.suspicion_level;
            EXPECT_NE(comparison.verdict, golden::Verdict::fail) << comparison.reason;
        }
        // The probability of 5 or more of 16 at a rate of 5% is 1e-3, and 5% is an upper bound.
        EXPECT_LT(suspected, 5) << batches;
    }
}

// Each of these powers is at least 0.97 in the long version. In 8 trials the probability of 2 or more
// misses is 2%, and that of 3 or more is 0.1%.
TEST(Power, FindsAPercentEverywhere)
{
    const Verdicts v = measure_verdicts(golden::Method::ranks, Noise::lognormal, Noise::lognormal,
                                        {.everywhere = 0.99}, small_plan(128, 1, 6));
    EXPECT_EQ(v.fail, v.trials());
}

TEST(Power, FindsThreeTenthsOfAPercentEverywhere)
{
    const Verdicts v = measure_verdicts(golden::Method::ranks, Noise::lognormal, Noise::lognormal,
                                        {.everywhere = 0.997}, small_plan(128, 1, 8));
    EXPECT_GE(v.fail, v.trials() - 2);
}

TEST(Power, FindsTwoPercentInShadows)
{
    const Verdicts v = measure_verdicts(golden::Method::ranks, Noise::lognormal, Noise::lognormal,
                                        {.in_shadow = 0.98}, small_plan(128, 1, 8));
    EXPECT_GE(v.fail, v.trials() - 1);
}

TEST(Power, ARightPicturePasses)
{
    const Verdicts v = measure_verdicts(golden::Method::ranks, Noise::lognormal, Noise::lognormal, {},
                                        small_plan(128, 1, 6));
    EXPECT_EQ(v.pass, v.trials());
}

TEST(RateInterval, IsThatOfTheTables)
{
    // Clopper and Pearson, 95%: 0 of 10 up to 0.3085; 5 of 10 from 0.1871 to 0.8129.
    EXPECT_EQ(rate_interval({0, 10}).low, 0.0);
    EXPECT_NEAR(rate_interval({0, 10}).high, 0.3085, 5e-5);
    EXPECT_NEAR(rate_interval({5, 10}).low, 0.1871, 5e-5);
    EXPECT_NEAR(rate_interval({5, 10}).high, 0.8129, 5e-5);
    EXPECT_EQ(rate_interval({10, 10}).high, 1.0);
}

} // namespace
