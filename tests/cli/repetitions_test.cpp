// The number of repetitions of a time measurement, tested with a simulated clock.

#include "cli/repetitions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using cli::Precision;
using cli::repeat_until_precise;
using cli::Repetitions;

/// Simulated work. The first call takes `first` seconds, the later calls take the times of `later` in
/// turn.
struct Clocked {
    std::vector<double> later;
    double first = 1;
    double time = 0;
    std::size_t calls = 0;

    Repetitions measure(const Precision& precision)
    {
        return repeat_until_precise([&] { return time; },
                                    [&] {
                                        time += calls == 0 ? first : later[(calls - 1) % later.size()];
                                        ++calls;
                                    },
                                    precision);
    }
};

const Precision two_percent{.relative = 0.02, .fewest = 5, .most_seconds = 1000, .shortest = 0.5};

TEST(Repetitions, OfWorkThatTakesTheSameEachTimeAreTheFewest)
{
    Clocked work{.later = {2}, .first = 7}; // the first does not count: caches are cold
    const Repetitions measured = work.measure(two_percent);
    EXPECT_EQ(measured.count, 5);
    EXPECT_EQ(work.calls, 6u);
    EXPECT_EQ(measured.seconds, 2);
    EXPECT_EQ(measured.relative_standard_error, 0);
}

// The times are 0.9 and 1.1 in turn. For even n, the mean is 1 and the standard error is
// 0.1 / sqrt(n - 1). The standard error is below 0.02 from n = 27 on. This n is odd: the mean is
// 1 - 0.1/27, and the sum of squared deviations from the mean is 27 * 0.01 (1 - 1/27^2).
TEST(Repetitions, GoOnUntilTheMeanIsAsPreciseAsAskedFor)
{
    Clocked work{.later = {0.9, 1.1}};
    const Repetitions measured = work.measure(two_percent);
    EXPECT_EQ(measured.count, 27);
    const double mean = 1 - 0.1 / 27;
    EXPECT_NEAR(measured.seconds, mean, 1e-12);
    EXPECT_NEAR(measured.relative_standard_error, std::sqrt(0.01 * (1 - 1 / 729.0) / 26) / mean, 1e-12);
    EXPECT_LT(measured.relative_standard_error, 0.02);
}

TEST(Repetitions, EndWithTheTimeAllowedAndTellThePrecisionReached)
{
    Clocked work{.later = {1, 3}};
    Precision short_time = two_percent;
    short_time.most_seconds = 7;
    const Repetitions measured = work.measure(short_time); // 1 + 3 + 1 + 3 = 8
    EXPECT_EQ(measured.count, 4);
    EXPECT_EQ(measured.seconds, 2);
    EXPECT_NEAR(measured.relative_standard_error, 1 / std::sqrt(3.0) / 2, 1e-12);
}

TEST(Repetitions, AreAtLeastTwoHoweverLongTheyTake)
{
    Clocked work{.later = {5000, 5000}};
    EXPECT_EQ(work.measure(two_percent).count, 2);
}

// A call takes 1/1024 s, which is below `shortest`. 512 calls take 0.5 s.
TEST(Repetitions, OfShortWorkDoItSeveralTimes)
{
    Clocked work{.later = {1.0 / 1024}, .first = 1.0 / 1024};
    const Repetitions measured = work.measure(two_percent);
    EXPECT_EQ(measured.count, 5);
    EXPECT_EQ(measured.seconds, 1.0 / 1024);
    EXPECT_EQ(work.calls, (1u + 2 + 4 + 8 + 16 + 32 + 64 + 128 + 256 + 512) + 5 * 512);
}

TEST(Repetitions, EndThoughTheClockStandsStill)
{
    Clocked work{.later = {0}, .first = 0};
    const Repetitions measured = work.measure(two_percent);
    EXPECT_EQ(measured.seconds, 0);
    EXPECT_TRUE(std::isinf(measured.relative_standard_error));
}

} // namespace
