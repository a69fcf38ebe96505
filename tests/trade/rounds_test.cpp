// Means, ratios and intervals over rounds, and the order of the measurements in a round.

#include "trade/rounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace {

using namespace trade;

// Student's t for two degrees of freedom at 97.5% is 4.302653, for one 12.706205.
TEST(Rounds, MeansHaveStudentsInterval)
{
    const Measured three = mean_of_rounds({1.0, 2.0, 3.0});
    EXPECT_DOUBLE_EQ(three.mean, 2.0);
    EXPECT_NEAR(three.half_width, 4.302653 / std::sqrt(3.0), 1e-6);
    const Measured two = mean_of_rounds({1.0, 3.0});
    EXPECT_NEAR(two.half_width, 12.706205 * 1.0, 1e-6); // standard error sqrt(2 / 2)
    EXPECT_EQ(mean_of_rounds({5.0, 5.0, 5.0}).half_width, 0.0);
    EXPECT_THROW(mean_of_rounds({1.0}), std::invalid_argument);
}

TEST(Rounds, IntervalsHoldTheTruthNineteenTimesOfTwenty)
{
    std::mt19937_64 random(std::random_device{}());
    std::normal_distribution<double> normal(3.0, 0.5);
    constexpr int trials = 4000;
    int held = 0;
    for (int i = 0; i < trials; ++i) {
        std::vector<double> rounds(5);
        std::ranges::generate(rounds, [&] { return normal(random); });
        const Measured measured = mean_of_rounds(rounds);
        held += std::abs(measured.mean - 3.0) <= measured.half_width ? 1 : 0;
    }
    // Six standard deviations of the binomial: one false alarm in 5e8.
    EXPECT_NEAR(held, 0.95 * trials, 6.0 * std::sqrt(0.95 * 0.05 * trials));
}

// If the machine is slower by any factor during a whole round, the ratio does not change.
TEST(Rounds, WhatSlowsAWholeRoundCancelsInTheRatio)
{
    const Estimate ratio = ratio_of_rounds({2.0, 20.0, 0.2}, {1.0, 10.0, 0.1});
    EXPECT_NEAR(ratio.value, 2.0, 1e-12);
    EXPECT_NEAR(ratio.low, 2.0, 1e-12);
    EXPECT_NEAR(ratio.high, 2.0, 1e-12);
    EXPECT_TRUE(ratio.decided());
}

TEST(Rounds, ARatioIsDecidedOnlyIfItsIntervalLeavesOutOne)
{
    const double half = 12.706205 * std::log(2.0); // of logarithms 0 and 2 log 2, with mean log 2
    const Estimate open = ratio_of_rounds({1.0, 4.0}, {1.0, 1.0});
    EXPECT_NEAR(open.value, 2.0, 1e-12);
    EXPECT_NEAR(std::log(open.high / open.value), half, 1e-6);
    EXPECT_NEAR(std::log(open.value / open.low), half, 1e-6);
    EXPECT_FALSE(open.decided());
    EXPECT_TRUE((Estimate{0.5, 0.4, 0.9}.decided()));
    EXPECT_TRUE((Estimate{2.0, 1.1, 3.0}.decided()));
    EXPECT_FALSE((Estimate{2.0, 0.9, 3.0}.decided()));
    EXPECT_THROW(ratio_of_rounds({1.0, 0.0}, {1.0, 1.0}), std::invalid_argument);
    EXPECT_THROW(ratio_of_rounds({1.0, 1.0}, {1.0, NAN}), std::invalid_argument);
    EXPECT_THROW(ratio_of_rounds({1.0, 1.0}, {1.0, 1.0, 1.0}), std::invalid_argument);
}

TEST(Rounds, EveryRoundMeasuresAllInAnOrderOfItsOwn)
{
    std::mt19937_64 random(std::random_device{}());
    std::vector<std::vector<int>> orders(60);
    std::vector<Measurement> measurements;
    for (int i = 0; i < 3; ++i)
        measurements.emplace_back([&, i](std::size_t round) {
            orders[round].push_back(i);
            return 100.0 * i + static_cast<double>(round);
        });
    const auto values = measure_in_rounds(orders.size(), random, measurements);
    ASSERT_EQ(values.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t round = 0; round < orders.size(); ++round)
            EXPECT_EQ(values[i][round], 100.0 * double(i) + double(round));
    std::set<std::vector<int>> different;
    for (std::vector<int> order : orders) {
        different.insert(order);
        std::ranges::sort(order);
        EXPECT_EQ(order, (std::vector{0, 1, 2}));
    }
    EXPECT_EQ(different.size(), 6u); // one is missing in less than one of 9,000 runs
}

TEST(Rounds, AreWrittenAsExactlyAsTheyAreKnown)
{
    EXPECT_EQ(to_text(Measured{0.026312, 0.000512}), "0.02631 +- 0.00051");
    EXPECT_EQ(to_text(Measured{315.2, 12.3}), "315 +- 12");
    EXPECT_EQ(to_text(Measured{31523.0, 1234.0}), "31523 +- 1234");
    EXPECT_EQ(to_text(Measured{2.0, 0.0}), "2.000 +- 0.000");
    EXPECT_EQ(to_text(Estimate{1.7345, 1.6, 1.88123}), "1.73 (1.6 to 1.88)");
}

} // namespace
