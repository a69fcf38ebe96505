// Few pictures: how often right ones FAIL, and what is known of their noise. docs/comparison.md,
// section 5.

#include "golden/pixel_noise.h"
#include "tests/golden/simulated_golden.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

namespace {

using golden::MeanEstimate;
using golden::Moments;
using golden::PixelNoise;

constexpr double tests = 1000.0;
constexpr double level_of_one = 1e-8 / tests;
constexpr double golden_size = 192.0;
constexpr double many = 1e4; // degrees of freedom of the noise of all pixels

/// The smallest difference that is rejected: where `p_of` falls below the level.
double critical(const std::function<double(double)>& p_of)
{
    double low = 0.0;
    double high = 40.0; // standard deviations of a normal distribution: never exceeded
    for (int i = 0; i < 40; ++i) {
        const double middle = (low + high) / 2.0;
        (p_of(middle) < level_of_one ? high : low) = middle;
    }
    return high;
}

/// The density of a chi-squared variable of `degrees` degrees.
double chi_squared(double degrees, double x)
{
    return std::exp((degrees / 2.0 - 1.0) * std::log(x) - x / 2.0 - degrees / 2.0 * std::log(2.0) -
                    std::lgamma(degrees / 2.0));
}

/// The expected number of rejections among `tests` tests of right pictures, whose mean has the variance
/// 1, beside a golden whose mean has the variance `of_golden`. estimate(variance of the values): what is
/// made of it. The integral of the chance to reject over the distribution of the variance that is found.
double rejections(double pictures, double of_golden, const std::function<MeanEstimate(double)>& estimate)
{
    const double degrees = pictures - 1.0;
    constexpr double step = 0.05; // of the logarithm of the variance
    double chance = 0.0;
    for (double logarithm = -20.0; logarithm < 6.0; logarithm += step) {
        const double x = std::exp(logarithm);
        MeanEstimate found = estimate(pictures * x / degrees);
        const double difference = critical([&](double d) {
            found.mean = d;
            return golden::welch(found, {0.0, of_golden, golden_size - 1.0}).p;
        });
        chance += chi_squared(degrees, x) * x * step *
                  std::erfc(difference / std::sqrt(2.0 * (1.0 + of_golden)));
    }
    return tests * chance;
}

double by_own_variance(double pictures, double of_golden)
{
    return rejections(pictures, of_golden, [&](double variance) {
        return golden::mean_estimate({pictures, 0.0, variance, 0.0});
    });
}

/// If the pictures' values have `dependence` times the variance of independent pixels.
double by_moderated_variance(double pictures, double of_golden, double dependence)
{
    const PixelNoise pixels{pictures / dependence, many, 0.0};
    return rejections(pictures, of_golden, [&](double variance) {
        return golden::moderated({pictures, 0.0, variance, 0.0}, pixels);
    });
}

TEST(FewPictures, FailFarTooOftenByTheVarianceOfTheirOwnValues)
{
    EXPECT_NEAR(by_own_variance(8.0, 0.1), 1e-3, 3e-4);
    EXPECT_NEAR(by_own_variance(16.0, 0.1), 6e-6, 1e-6);
    EXPECT_NEAR(by_own_variance(32.0, 0.1), 1e-7, 2e-8);
}

TEST(FewPictures, KeepTheLevelWithTheVarianceOfTheirPixels)
{
    for (const double pictures : {2.0, 4.0, 8.0, 16.0, 32.0, 64.0})
        for (const double of_golden : {0.001, 0.1, 1.0}) {
            EXPECT_LT(by_moderated_variance(pictures, of_golden, 1.0), 1e-8)
                << pictures << ", " << of_golden;
            EXPECT_LT(by_moderated_variance(pictures, of_golden, 2.0), 2e-7)
                << pictures << ", " << of_golden;
        }
}

TEST(FewPictures, OfWhichOnePixelHasAllTheNoiseHaveTheirOwnDegrees)
{
    // The pixel's variance is that of the values: nothing new is known.
    const MeanEstimate same = golden::moderated({4.0, 1.0, 0.5, 0.0}, {0.5, 3.0, 0.0});
    EXPECT_EQ(same.degrees, 3.0);
    EXPECT_EQ(same.variance, 0.5 / 4.0);
    const MeanEstimate more = golden::moderated({4.0, 1.0, 0.5, 0.0}, {1.0, many, 0.0});
    EXPECT_EQ(more.degrees, 11.0);
    EXPECT_DOUBLE_EQ(more.variance, (3.0 * 0.5 + 8.0 * 1.0) / 11.0 / 4.0);
    // Without noise in any pixel.
    EXPECT_EQ(golden::moderated({4.0, 1.0, 0.0, 0.0}, {}).degrees, 3.0);
}

TEST(FewPictures, OfTwoTheSkewnessIsThatOfTheGoldenScaledToTheirNoise)
{
    const Moments reference{512.0, 1.0, 0.04, 0.6};
    const PixelNoise pixels{0.16, many, std::nan("")};
    // Four times the variance, as of four times fewer samples: twice the skewness; the mean of two.
    EXPECT_DOUBLE_EQ(golden::mean_skewness({2.0, 1.0, 0.16, 0.0}, pixels, reference),
                     2.0 * 0.6 / std::sqrt(2.0));
}

TEST(FewPictures, WhoseValuesScatterMoreThanTheirPixelsAreMoreSkewed)
{
    const Moments reference{512.0, 1.0, 0.04, 0.6};
    const PixelNoise pixels{1.0, many, 0.3};
    EXPECT_DOUBLE_EQ(golden::mean_skewness({100.0, 1.0, 1.0, 0.0}, pixels, reference), 0.03);
    // (99 * 4 + 8) / 107 times the variance of independent pixels.
    EXPECT_DOUBLE_EQ(golden::mean_skewness({100.0, 1.0, 4.0, 0.0}, pixels, reference),
                     0.03 * std::sqrt(404.0 / 107.0));
    // What the values show beyond twice its standard error counts: a dependence that pixels do not show.
    const double error = std::sqrt(6.0 * 98.0 / (101.0 * 103.0));
    EXPECT_DOUBLE_EQ(golden::mean_skewness({100.0, 1.0, 1.0, -2.0}, pixels, reference),
                     (2.0 - 2.0 * error) / 10.0);
}

class FewPicturesOf : public golden_test::SimulatedGolden {
protected:
    static std::vector<images::Image> pictures(int count, std::uint64_t seed,
                                               const calibration::Bias& bias = {})
    {
        std::vector<images::Image> result;
        for (int i = 0; i < count; ++i)
            result.push_back(picture(16, seed + static_cast<std::uint64_t>(i), bias));
        return result;
    }
};

/// Each pixel gamma distributed, so that all cumulants of the weighted sum are known.
TEST_F(FewPicturesOf, IndependentPixelsHaveTheCumulantsOfTheirWeightedSum)
{
    constexpr int count = 6;
    constexpr double shape = 0.5;
    const golden::Functionals& functionals = reference().functionals;
    std::mt19937_64 random(3);
    std::gamma_distribution<double> gamma(shape);
    double variance = 0.0;
    double third = 0.0;
    double share_of_one = 0.0;
    constexpr int repeats = 40;
    constexpr std::size_t plain_of_whole = 1;
    for (int repeat = 0; repeat < repeats; ++repeat) {
        golden::Candidate candidate(functionals);
        for (int i = 0; i < count; ++i) {
            images::Image image(golden_test::size, golden_test::size);
            for (images::Rgb& pixel : image.pixels) pixel = images::Rgb(gamma(random));
            candidate.add_batch(image);
        }
        const PixelNoise noise = golden::pixel_noise(candidate, plain_of_whole, 0);
        variance += noise.variance / repeats;
        third += noise.skewness * std::pow(noise.variance, 1.5) / repeats;
        share_of_one += 1.0 / noise.degrees / repeats;
    }
    double square = 0.0;
    double cube = 0.0;
    for (std::size_t i = 0; i < 1024; ++i) {
        const double weight = functionals.pixel_weight(plain_of_whole, 0, i);
        square += weight * weight;
        cube += weight * weight * weight;
    }
    // Variance `shape` and third cumulant 2 `shape`. Five standard errors: the variance of a sample
    // variance is sigma^4 (2 / 5 + 12 / 6) = 2.4 sigma^4, over 1024 pixels and 40 repeats; a third
    // cumulant of 6 values scatters by about 15 sigma^3 (by trial).
    const double pixels = 1024.0 * repeats;
    EXPECT_NEAR(variance / (square * shape), 1.0, 5.0 * std::sqrt(2.4 / pixels));
    // (B - 1) N degrees if the squares of the variances were known. The mean square of a sample variance
    // is 1 + 2.4 times sigma^4; one sum of them scatters by about 20% (by trial).
    EXPECT_NEAR(share_of_one * 5.0 * 1024.0 / 3.4, 1.0, 5.0 * 0.2 / std::sqrt(repeats));
    EXPECT_NEAR(third / (cube * 2.0 * shape), 1.0,
                5.0 * 15.0 * std::pow(shape, 1.5) / std::sqrt(pixels));
}

TEST_F(FewPicturesOf, RightOnesAreConclusiveAndPassIfTheyAreEnough)
{
    for (const int count : {2, 4, 8, 16, 32}) {
        const golden::Comparison result = golden::compare_pictures(reference(), pictures(count, 500),
                                                                   golden_test::for_small_pictures());
        EXPECT_EQ(result.verdict, count < 4 ? golden::Verdict::inconclusive : golden::Verdict::pass)
            << count << ": " << result.reason;
        EXPECT_GT(result.coverage, count < 8 ? 0.7 : 0.9) << count;
        for (const double error : result.detectable) EXPECT_LT(error, 0.2 / std::sqrt(count)) << count;
    }
}

TEST_F(FewPicturesOf, WrongOnesFail)
{
    EXPECT_EQ(golden::compare_pictures(reference(), pictures(8, 100, {.everywhere = 0.96})).verdict,
              golden::Verdict::fail);
    EXPECT_EQ(golden::compare_pictures(reference(), pictures(2, 100, {.everywhere = 0.8})).verdict,
              golden::Verdict::fail);
}

TEST_F(FewPicturesOf, NoMessageHasInfinitiesInIt)
{
    for (const int count : {2, 3, 5, 16})
        for (const double factor : {0.0, 0.5, 0.99, 1.0, 2.0}) {
            const std::string reason =
                golden::compare_pictures(reference(), pictures(count, 7, {.everywhere = factor})).reason;
            EXPECT_EQ(reason.find("inf"), std::string::npos) << reason;
            EXPECT_EQ(reason.find("nan"), std::string::npos) << reason;
        }
}

} // namespace
