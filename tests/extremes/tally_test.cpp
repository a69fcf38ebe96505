#include "extremes/tally.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace extremes {

TEST(Tally, CountsErrorsAndFailures)
{
    Tally tally;
    tally.add(0.0);
    tally.add(1e-16);
    tally.add(0.5);
    tally.add(std::numeric_limits<double>::quiet_NaN());
    tally.add(std::numeric_limits<double>::infinity());
    tally.add(Failure::leaked);
    tally.refuse("too large");
    tally.refuse("far too large");
    EXPECT_EQ(tally.cases(), 8u);
    EXPECT_EQ(tally.errors(), 3u);
    EXPECT_EQ(tally.failures(Failure::not_finite), 2u);
    EXPECT_EQ(tally.failures(Failure::inaccurate), 1u);
    EXPECT_EQ(tally.failures(Failure::leaked), 1u);
    EXPECT_EQ(tally.failures(Failure::refused), 2u);
    EXPECT_EQ(tally.failures(), 6u);
    EXPECT_EQ(tally.refusal(), "too large");
    EXPECT_EQ(tally.largest(), 0.5);
}

TEST(Tally, QuantilesAreThoseOfTheErrorsUpToTheWidthOfABin)
{
    Tally tally;
    for (int i = 1; i <= 1000; ++i) tally.add(i * 1e-10);
    const double bin = std::pow(10.0, 1.0 / 16);
    for (const double q : {0.01, 0.5, 0.99}) {
        EXPECT_GE(tally.quantile(q), q * 1e-7 * (1 - 1e-9));
        EXPECT_LE(tally.quantile(q), q * 1e-7 * bin * (1 + 1e-9));
    }
    EXPECT_EQ(tally.quantile(1.0), 1000 * 1e-10);
    EXPECT_EQ(Tally{}.quantile(0.5), 0.0);
}

TEST(Tally, MoreThanHalfZerosHaveAMedianOfZero)
{
    Tally tally;
    for (int i = 0; i < 6; ++i) tally.add(0.0);
    for (int i = 0; i < 4; ++i) tally.add(1e-3);
    EXPECT_EQ(tally.quantile(0.5), 0.0);
    EXPECT_GT(tally.quantile(0.7), 9e-4);
}

TEST(Tally, AddsToAnother)
{
    Tally a;
    Tally b;
    a.add(1e-3);
    b.add(1e-5);
    b.add(Failure::missed);
    b.refuse("no");
    b.leave_out("too large");
    a += b;
    EXPECT_EQ(a.cases(), 4u);
    EXPECT_EQ(a.errors(), 2u);
    EXPECT_EQ(a.largest(), 1e-3);
    EXPECT_EQ(a.failures(Failure::missed), 1u);
    EXPECT_EQ(a.refusal(), "no");
    EXPECT_EQ(a.left_out(), "too large");
}

} // namespace extremes
