// How often right pictures fail Welch's test if there are few of them: the chance to reject, integrated
// over the distribution of the variance that is found. docs/own-code.md holds the numbers.

#include "golden/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace {

constexpr double tests = 1000.0;
constexpr double level = 1e-8 / tests;
constexpr double golden_batches = 192.0;

/// The smallest difference that is rejected: where `p_of` falls below the level.
double critical(const std::function<double(double)>& p_of)
{
    double low = 0.0;
    double high = 40.0; // standard deviations of a normal distribution: never exceeded
    for (int i = 0; i < 40; ++i) {
        const double middle = (low + high) / 2.0;
        (p_of(middle) < level ? high : low) = middle;
    }
    return high;
}

/// The density of a chi-squared variable of `degrees` degrees.
double chi_squared(double degrees, double x)
{
    return std::exp((degrees / 2.0 - 1.0) * std::log(x) - x / 2.0 - degrees / 2.0 * std::log(2.0) -
                    std::lgamma(degrees / 2.0));
}

/// The expected number of rejections among `tests` tests of `pictures` right pictures, whose mean has
/// the variance 1, beside a golden whose mean has the variance `of_golden`. `p(found, difference)`: the
/// p-value if the variance `found` was found.
double rejections(double pictures, double of_golden, const std::function<double(double, double)>& p)
{
    const double degrees = pictures - 1.0;
    constexpr double step = 0.05; // of the logarithm of the variance
    double chance = 0.0;
    for (double logarithm = -20.0; logarithm < 6.0; logarithm += step) {
        const double x = std::exp(logarithm);
        const double difference = critical([&](double d) { return p(x / degrees, d); });
        chance += chi_squared(degrees, x) * x * step *
                  std::erfc(difference / std::sqrt(2.0 * (1.0 + of_golden)));
    }
    return tests * chance;
}

double by_welch(double pictures, double of_golden)
{
    return rejections(pictures, of_golden, [&](double found, double difference) {
        return golden::welch({difference, found, pictures - 1.0}, {0.0, of_golden, golden_batches - 1.0},
                             0.0)
            .p;
    });
}

/// With the degrees of the pictures alone.
double by_own_degrees(double pictures, double of_golden)
{
    return rejections(pictures, of_golden, [&](double found, double difference) {
        return golden::welch({difference, found + of_golden, pictures - 1.0},
                             {0.0, 0.0, golden_batches - 1.0}, 0.0)
            .p;
    });
}

TEST(FewPictures, FailFarTooOftenByWelchsTest)
{
    EXPECT_NEAR(by_welch(8.0, 0.1), 1e-3, 3e-4);
    EXPECT_NEAR(by_welch(16.0, 0.1), 6e-6, 1e-6);
    EXPECT_NEAR(by_welch(32.0, 0.1), 1e-7, 2e-8);
}

TEST(FewPictures, KeepTheLevelWithTheirOwnDegrees)
{
    for (const double pictures : {4.0, 8.0, 16.0, 64.0})
        for (const double of_golden : {0.001, 0.1, 1.0})
            EXPECT_LT(by_own_degrees(pictures, of_golden), 1.05e-8) << pictures << ", " << of_golden;
}

} // namespace
