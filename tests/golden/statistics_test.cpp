#include "golden/rare_events.h"
#include "golden/statistics.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

namespace {

using golden::MeanEstimate;
using golden::TestResult;
using Values = std::vector<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();

Values sorted(Values values)
{
    std::sort(values.begin(), values.end());
    return values;
}

/// Two samples, a of n values and b of m values, without ties. Exactly u pairs have a > b.
std::array<Values, 2> samples_with_u(int n, int m, int u)
{
    Values a;
    Values b(static_cast<std::size_t>(m));
    std::iota(b.begin(), b.end(), 1.0);
    for (int i = 0; i < n; ++i) {
        const int below = std::min(m, u); // the number of values of b below this value
        a.push_back(below + 0.5 + i * 1e-3);
        u -= below;
    }
    return {sorted(a), b};
}

/// A few values, many of them equal.
Values values_with_ties()
{
    const auto integers = *rc::gen::resize(
        9, rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 5))));
    return sorted(Values(integers.begin(), integers.end()));
}

Values any_values()
{
    const auto words =
        *rc::gen::resize(40, rc::gen::nonEmpty(rc::gen::container<std::vector<std::int32_t>>(
                                 rc::gen::resize(100, rc::gen::arbitrary<std::int32_t>()))));
    Values values;
    for (const std::int32_t word : words) values.push_back(std::ldexp(word, -31));
    return sorted(values);
}

// Increase of sleep by two drugs [Student 1908]: the example of R's t.test and wilcox.test.
const Values first_drug = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
const Values second_drug = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

TEST(Moments, AreThoseOfTheTextbook)
{
    const golden::Moments m = golden::moments(Values{0.0, 0.0, 0.0, 1.0});
    EXPECT_EQ(m.count, 4.0);
    EXPECT_EQ(m.mean, 0.25);
    EXPECT_DOUBLE_EQ(m.variance, 0.25);
    // The skewness of a Bernoulli variable with p = 1/4 is (1 - 2 p) / sqrt(p (1 - p)).
    EXPECT_DOUBLE_EQ(m.skewness, 0.5 / std::sqrt(0.1875));
}

RC_GTEST_PROP(Moments, OfPooledSamplesAreThoseOfAllValues, ())
{
    const auto samples = *rc::gen::container<std::vector<std::vector<int>>>(
        rc::gen::container<std::vector<int>>(rc::gen::inRange(-1000, 1001)));
    Values all;
    std::vector<golden::Moments> each;
    for (const std::vector<int>& sample : samples) {
        const Values values(sample.begin(), sample.end());
        all.insert(all.end(), values.begin(), values.end());
        each.push_back(golden::moments(values));
    }
    const golden::Moments expected = golden::moments(all);
    const golden::Moments found = golden::pooled(each);
    // Sums of at most 1e4 terms of at most 8e9 each, relative to moments of at least order 1.
    const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-8 * (1.0 + std::abs(a)); };
    RC_ASSERT(found.count == expected.count);
    RC_ASSERT(near(expected.mean, found.mean));
    RC_ASSERT(near(expected.variance, found.variance));
    RC_ASSERT(near(expected.skewness, found.skewness));
}

TEST(Moments, OfNothingOneValueOrEqualValuesAreFinite)
{
    EXPECT_EQ(golden::moments({}).mean, 0.0);
    EXPECT_EQ(golden::moments(Values{7.0}).variance, 0.0);
    EXPECT_EQ(golden::moments(Values{7.0, 7.0, 7.0}).skewness, 0.0);
    const golden::Moments equal =
        golden::moments(Values(32, 0.1)); // the sum of 32 such doubles is rounded
    EXPECT_EQ(equal.mean, 0.1);
    EXPECT_EQ(equal.variance, 0.0);
    EXPECT_EQ(equal.skewness, 0.0);
    // The squares underflow. The result must not be 0 / 0.
    EXPECT_EQ(golden::moments(Values{0.0, 1e-200}).skewness, 0.0);
}

// A golden of 224 batches: one in three has the value 3, the others have 0. Another estimator of the
// same mean, 1, may have events of up to four times what they add there, 8, and 32 pictures without any.
TEST(RareEvents, MayBeWhatADarkSampleLacks)
{
    const MeanEstimate golden{1.0, 2.0 / 224.0, 223.0};
    const MeanEstimate dark{0.001, 0.0, 31.0};
    const auto p = [&](double pictures, const MeanEstimate& candidate) {
        return golden::least_p_of_darkness(8.0, pictures, candidate, golden, 0.0);
    };
    // 32 / 8 events are expected; the noise of the golden may be a part of the difference.
    EXPECT_GT(p(32.0, dark), 2.0 * std::exp(-4.0));
    EXPECT_LT(p(32.0, dark), 2.2 * std::exp(-4.0));
    EXPECT_LT(p(2000.0, dark), 1e-80); // so many pictures would contain some
    EXPECT_EQ(p(32.0, {2.0, 0.0, 31.0}), 0.0);
    EXPECT_EQ(golden::least_p_of_darkness(0.0, 32.0, dark, golden, 0.0), 0.0);
    EXPECT_EQ(golden::least_p_of_darkness(8.0, 32.0, dark, golden, 1.0), 0.0);
}

// By integration: the light x that is missing by chance is x with exp(-B x / E), and the golden's noise
// is normal. The bound is above the chance of a difference d for each x, and at most a factor above the
// largest of them, that of a normal tail of the same Chernoff bound.
TEST(RareEvents, AndNoiseTogetherExplainADifferenceWithASmallerChanceThanTheBound)
{
    for (const double pictures : {2.0, 16.0, 256.0})
        for (const double error : {0.001, 0.03, 0.1})
            for (const double missing : {0.05, 0.2, 1.0}) {
                const double bound = golden::least_p_of_darkness(
                    1.0, pictures, {1.0 - missing, 0.0, 15.0}, {1.0, error * error, 200.0}, 0.0);
                double largest = 0.0;
                for (double x = 0.0; x <= missing; x += missing / 1000.0)
                    largest = std::max(largest, std::exp(-pictures * x) *
                                                    std::erfc((missing - x) / error / std::sqrt(2.0)));
                if (bound == 0.0) {
                    // The whole difference by noise is the most likely explanation: that of the t test.
                    EXPECT_DOUBLE_EQ(largest, std::erfc(missing / error / std::sqrt(2.0)));
                } else {
                    EXPECT_GE(bound, largest) << pictures << " " << error << " " << missing;
                    EXPECT_LE(bound, 30.0 * largest) << pictures << " " << error << " " << missing;
                }
            }
}

TEST(RareEvents, HideLessLightInMorePictures)
{
    const double hidden = golden::hidden_light(8.0, 32.0, 0.01);
    EXPECT_DOUBLE_EQ(std::exp(-32.0 * hidden / 8.0), 0.01);
    EXPECT_DOUBLE_EQ(golden::hidden_light(8.0, 64.0, 0.01), hidden / 2.0);
}

TEST(MannWhitney, CompleteSeparationIsOneArrangementOfAll)
{
    const auto [a, b] = samples_with_u(5, 5, 25);
    EXPECT_DOUBLE_EQ(golden::mann_whitney(a, b).p, 2.0 / 252.0); // 252 = 10 choose 5
    EXPECT_GT(golden::mann_whitney(a, b).z, 0.0);
    EXPECT_DOUBLE_EQ(golden::mann_whitney(b, a).p, 2.0 / 252.0);
    EXPECT_LT(golden::mann_whitney(b, a).z, 0.0);
}

TEST(MannWhitney, HasTheCriticalValuesOfThePublishedTables)
{
    // The largest U that is significant at 5%, two-sided, for n and m.
    constexpr std::array<std::array<int, 3>, 5> table = {
        {{5, 5, 2}, {8, 8, 13}, {7, 12, 18}, {10, 10, 23}, {20, 20, 127}}};
    for (const auto& [n, m, critical] : table) {
        const auto [a, b] = samples_with_u(n, m, critical);
        const auto [c, d] = samples_with_u(n, m, critical + 1);
        EXPECT_LE(golden::mann_whitney(a, b).p, 0.05) << n << " " << m;
        EXPECT_GT(golden::mann_whitney(c, d).p, 0.05) << n << " " << m;
    }
}

TEST(MannWhitney, WithTiesAndContinuityCorrectionIsThatOfR)
{
    // wilcox.test(extra ~ group, data = sleep, exact = FALSE): p-value = 0.06933
    EXPECT_NEAR(golden::mann_whitney(sorted(first_drug), sorted(second_drug)).p, 0.06933, 5e-6);
}

// The variance of U over all ways to split the pooled values, by enumeration.
RC_GTEST_PROP(MannWhitney, VarianceUnderTiesIsThatOfAllArrangements, ())
{
    Values pool = values_with_ties();
    while (pool.size() < 3) pool.push_back(0.0);
    pool = sorted(pool);
    const auto n = static_cast<std::size_t>(*rc::gen::inRange(1, static_cast<int>(pool.size())));
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    const double middle = static_cast<double>(n * (pool.size() - n)) / 2.0;
    std::vector<TestResult> results;
    std::vector<double> us;
    std::vector<bool> in_a(pool.size(), false);
    std::fill(in_a.end() - static_cast<std::ptrdiff_t>(n), in_a.end(), true);
    do {
        Values a;
        Values b;
        for (std::size_t i = 0; i < pool.size(); ++i) (in_a[i] ? a : b).push_back(pool[i]);
        double u = 0.0;
        for (const double x : a)
            for (const double y : b) u += x > y ? 1.0 : x == y ? 0.5 : 0.0;
        sum += u;
        squares += (u - middle) * (u - middle);
        count += 1.0;
        us.push_back(u);
        results.push_back(golden::mann_whitney(a, b));
    } while (std::next_permutation(in_a.begin(), in_a.end()));
    RC_ASSERT(sum == middle * count); // exact: multiples of 1/2
    for (std::size_t i = 0; i < us.size(); ++i) {
        // The continuity correction is half a step towards the middle. The tolerance is the rounding of
        // a few operations.
        const double expected =
            squares == 0.0 ? 0.0
                           : std::max(0.0, std::abs(us[i] - middle) - 0.5) / std::sqrt(squares / count);
        RC_ASSERT(std::abs(std::abs(results[i].z) - expected) <= 1e-12 * (1.0 + expected));
    }
}

RC_GTEST_PROP(MannWhitney, ExchangingTheSamplesTurnsTheSign, ())
{
    const Values a = *rc::gen::element(true, false) ? any_values() : values_with_ties();
    const Values b = *rc::gen::element(true, false) ? any_values() : values_with_ties();
    const TestResult ab = golden::mann_whitney(a, b);
    const TestResult ba = golden::mann_whitney(b, a);
    RC_ASSERT(ab.z == -ba.z);
    RC_ASSERT(ab.p == ba.p);
    RC_ASSERT(ab.p > 0.0);
    RC_ASSERT(ab.p <= 1.0);
}

RC_GTEST_PROP(MannWhitney, DependsOnlyOnTheOrderOfTheValues, ())
{
    Values a = any_values();
    Values b = any_values();
    const TestResult before = golden::mann_whitney(a, b);
    for (Values* values : {&a, &b})
        for (double& value : *values) value = std::ldexp(value, value > 0.0 ? 40 : 3); // exact
    const TestResult after = golden::mann_whitney(a, b);
    RC_ASSERT(before.z == after.z);
    RC_ASSERT(before.p == after.p);
}

RC_GTEST_PROP(MannWhitney, RaisingASampleNeverLowersIt, ())
{
    const Values a = any_values();
    const Values b = any_values();
    const double shift = std::abs(any_values().front());
    RC_ASSERT(golden::mann_whitney(a, b, shift).z >= golden::mann_whitney(a, b).z);
}

/// Expects uniform p-values over trials of `test` with new random numbers: the share of p-values up to
/// each of three levels is that level.
template <class Test>
void expect_uniform_p(const Test& test, int trials)
{
    std::mt19937_64 random(2);
    constexpr std::array levels = {0.2, 0.05, 0.01};
    std::array<int, 3> below{};
    for (int i = 0; i < trials; ++i) {
        const double p = test(random);
        for (std::size_t k = 0; k < levels.size(); ++k) below[k] += p <= levels[k];
    }
    for (std::size_t k = 0; k < levels.size(); ++k) {
        // Binomial, 4.5 standard deviations: alpha = 7e-6. The normal approximation may be off by a few
        // percent of the level.
        const double expected = levels[k] * trials;
        EXPECT_NEAR(below[k], expected, 4.5 * std::sqrt(expected) + 0.05 * expected) << levels[k];
    }
}

TEST(MannWhitney, PValuesOfEqualDistributionsAreUniformHoweverHeavyTheTail)
{
    const auto cauchy = [](std::mt19937_64& random, std::size_t count) {
        Values values(count);
        for (double& value : values) value = std::cauchy_distribution<double>()(random);
        return sorted(values);
    };
    expect_uniform_p(
        [&](std::mt19937_64& random) {
            const Values a = cauchy(random, 64);
            return golden::mann_whitney(a, cauchy(random, 200)).p;
        },
        10'000);
}

TEST(MannWhitney, NothingAndConstantsAndDisorderAreOrdinaryInputs)
{
    EXPECT_EQ(golden::mann_whitney({}, Values{1.0}).p, 1.0);
    EXPECT_EQ(golden::mann_whitney(Values{1.0}, {}).p, 1.0);
    EXPECT_EQ(golden::mann_whitney(Values(64, 3.0), Values(512, 3.0)).p, 1.0);
    EXPECT_THROW(golden::mann_whitney(Values{2.0, 1.0}, Values{1.0}), std::invalid_argument);
}

TEST(MannWhitney, ADifferenceWithinTheToleranceCountsAsEqual)
{
    const Values reference(512, 1.0);
    const Values rounded(64, 1.0 + 1e-6);
    EXPECT_LT(golden::mann_whitney(rounded, reference).p, 1e-50);
    EXPECT_EQ(golden::mann_whitney_beyond(rounded, reference, 2e-6).p, 1.0);
    EXPECT_LT(golden::mann_whitney_beyond(rounded, reference, 0.5e-6).p, 1e-50);
    EXPECT_GT(golden::mann_whitney_beyond(rounded, reference, 0.5e-6).z, 0.0);
    EXPECT_LT(golden::mann_whitney_beyond(reference, rounded, 0.5e-6).z, 0.0);
}

TEST(OneSided, CountsOnlyTheAskedDirection)
{
    EXPECT_DOUBLE_EQ(golden::one_sided({2.0, 0.04}, 1.0), 0.02);
    EXPECT_DOUBLE_EQ(golden::one_sided({2.0, 0.04}, -1.0), 0.98);
    EXPECT_DOUBLE_EQ(golden::one_sided({-2.0, 0.04}, -3.0), 0.02);
    EXPECT_EQ(golden::one_sided({}, 1.0), 1.0);
}

TEST(Welch, IsThatOfRForStudentsSleepers)
{
    // t.test(extra ~ group, data = sleep): t = -1.8608, df = 17.776, p-value = 0.07939
    const MeanEstimate a = golden::mean_estimate(golden::moments(first_drug));
    const MeanEstimate b = golden::mean_estimate(golden::moments(second_drug));
    EXPECT_NEAR(golden::welch_degrees(a, b), 17.776, 5e-4);
    EXPECT_NEAR(golden::welch(a, b).z, -1.8608, 5e-5);
    EXPECT_NEAR(golden::welch(a, b).p, 0.07939, 5e-6);
}

TEST(Welch, HasTheClosedFormOfOneAndTwoDegreesOfFreedom)
{
    const MeanEstimate known{0.0, 0.0, 1.0};
    for (const double t : {0.1, 1.0, 3.0, 50.0}) {
        // The relative accuracy of the library's tails. Verdicts depend only on much larger differences.
        EXPECT_NEAR(golden::welch({t, 1.0, 1.0}, known).p, 1.0 - 2.0 * std::atan(t) / std::numbers::pi,
                    1e-12);
        EXPECT_NEAR(golden::welch({t, 1.0, 2.0}, known).p, 1.0 - t / std::sqrt(2.0 + t * t), 1e-12);
    }
}

RC_GTEST_PROP(Welch, NeitherUnitsNorOrderChangeTheVerdict, ())
{
    Values a = any_values();
    Values b = any_values();
    a.push_back(0.25);
    b.push_back(-0.5);
    const auto test = [](const Values& x, const Values& y) {
        return golden::welch(golden::mean_estimate(golden::moments(x)),
                             golden::mean_estimate(golden::moments(y)));
    };
    const TestResult ab = test(a, b);
    const TestResult ba = test(b, a);
    RC_ASSERT(ab.z == -ba.z);
    RC_ASSERT(ab.p == ba.p);
    for (Values* values : {&a, &b})
        for (double& value : *values) value = std::ldexp(value, -60);
    RC_ASSERT(test(a, b).z == ab.z); // powers of two scale without rounding
}

TEST(Welch, PValuesOfEqualMeansAreUniform)
{
    expect_uniform_p(
        [](std::mt19937_64& random) {
            std::normal_distribution<double> wide(1.0, 3.0);
            std::normal_distribution<double> narrow(1.0, 1.0);
            Values a(12);
            Values b(40);
            for (double& value : a) value = wide(random);
            for (double& value : b) value = narrow(random);
            return golden::welch(golden::mean_estimate(golden::moments(a)),
                                 golden::mean_estimate(golden::moments(b)))
                .p;
        },
        10'000);
}

TEST(Welch, WithoutAnyNoiseOnlyADifferenceBeyondTheToleranceCounts)
{
    const MeanEstimate one{1.0, 0.0, 5.0};
    EXPECT_EQ(golden::welch(one, one).p, 1.0);
    EXPECT_EQ(golden::welch({1.001, 0.0, 5.0}, one).p, 0.0);
    EXPECT_EQ(golden::welch({1.001, 0.0, 5.0}, one).z, infinity);
    EXPECT_EQ(golden::welch({1.001, 0.0, 5.0}, one, 0.002).p, 1.0);
    // Rounding noise in both is not evidence of a difference. Here the means differ by 1e-9, with errors
    // of 1e-12.
    EXPECT_EQ(golden::welch({1.0 + 1e-9, 1e-24, 5.0}, {1.0, 1e-24, 5.0}, 2e-6).p, 1.0);
    EXPECT_THROW(golden::mean_estimate(golden::moments(Values{1.0})), std::invalid_argument);
}

TEST(RatioInterval, ToAKnownNumberIsTheIntervalOfTheMean)
{
    // Two degrees of freedom: the 97.5% quantile of t is 4.302653 in every table.
    const golden::Interval interval = golden::ratio_interval({6.0, 0.04, 2.0}, {3.0, 0.0, 2.0}, 0.95);
    EXPECT_NEAR(interval.low, (6.0 - 0.2 * 4.302653) / 3.0, 1e-6);
    EXPECT_NEAR(interval.high, (6.0 + 0.2 * 4.302653) / 3.0, 1e-6);
}

RC_GTEST_PROP(RatioInterval, OfTheInverseRatioIsTheInverse, ())
{
    const auto positive = [] { return *rc::gen::inRange(1, 1000) / 100.0; };
    const double relative_error = 0.05; // both means are significantly above 0
    const auto estimate = [&](double mean) {
        return MeanEstimate{mean, std::pow(relative_error * mean, 2.0), 10.0};
    };
    const MeanEstimate a = estimate(positive());
    const MeanEstimate b = estimate(positive());
    const golden::Interval ab = golden::ratio_interval(a, b, 0.99);
    const golden::Interval ba = golden::ratio_interval(b, a, 0.99);
    // The roots of a quadratic, without cancellation for these numbers. The error is a few tens of ulps.
    RC_ASSERT(std::abs(ab.low * ba.high - 1.0) <= 1e-12);
    RC_ASSERT(std::abs(ab.high * ba.low - 1.0) <= 1e-12);
    RC_ASSERT(ab.low < a.mean / b.mean);
    RC_ASSERT(a.mean / b.mean < ab.high);
}

TEST(RatioInterval, CoversTheTruthAsOftenAsItSays)
{
    std::mt19937_64 random(3);
    std::normal_distribution<double> normal;
    int covered = 0;
    constexpr int trials = 20'000;
    for (int i = 0; i < trials; ++i) {
        const MeanEstimate a{3.0 + 0.3 * normal(random), 0.09, infinity};
        const MeanEstimate b{2.0 + 0.4 * normal(random), 0.16, infinity};
        const golden::Interval interval = golden::ratio_interval(a, b, 0.9);
        covered += interval.low <= 1.5 && 1.5 <= interval.high;
    }
    // Fieller's interval is exact. Binomial, 4.5 standard deviations: alpha = 7e-6.
    EXPECT_NEAR(covered, 0.9 * trials, 4.5 * std::sqrt(0.09 * trials));
}

TEST(RatioInterval, OfADenominatorThatMayBeZeroIsTheWholeLine)
{
    const golden::Interval interval = golden::ratio_interval({1.0, 0.1, 9.0}, {0.1, 1.0, 9.0}, 0.99);
    EXPECT_EQ(interval.low, -infinity);
    EXPECT_EQ(interval.high, infinity);
}

TEST(Bonferroni, MultipliesUpToOne)
{
    EXPECT_DOUBLE_EQ(golden::bonferroni(0.01, 7.0), 0.07);
    EXPECT_EQ(golden::bonferroni(0.5, 7.0), 1.0);
}

TEST(AllExceed, OfOneSampleIsItsLevelAndOfAKnownReferenceTheProduct)
{
    // The tolerances: the error of the quadrature, and the error of a reference of 1e14 values.
    EXPECT_NEAR(golden::all_exceed(Values{64.0}, Values{1e-5}, 100.0), 1e-5, 1e-11);
    EXPECT_NEAR(golden::all_exceed(Values{64.0, 256.0}, Values{1e-2, 1e-3}, 1e14), 1e-5, 1e-9);
}

TEST(AllExceed, CountsTheErrorThatSamplesShareWithTheirReference)
{
    std::mt19937_64 random(6);
    std::normal_distribution<double> normal;
    constexpr int trials = 400'000;
    int both = 0;
    for (int i = 0; i < trials; ++i) {
        const double reference = normal(random) / std::sqrt(128.0);
        const double first = normal(random) / std::sqrt(64.0) - reference;
        const double second = normal(random) / std::sqrt(256.0) - reference;
        // A normal variable exceeds 1.644854 with a chance of 5%.
        both += first > 1.644854 * std::sqrt(1.0 / 64.0 + 1.0 / 128.0) &&
                second > 1.644854 * std::sqrt(1.0 / 256.0 + 1.0 / 128.0);
    }
    const double chance = golden::all_exceed(Values{64.0, 256.0}, Values{0.05, 0.05}, 128.0);
    EXPECT_GT(chance, 3.0 * 0.05 * 0.05);
    EXPECT_NEAR(both, chance * trials, 4.5 * std::sqrt(chance * trials)); // alpha = 7e-6
}

TEST(DetectableDifference, IsThatOfTheTablesOfSampleSizes)
{
    // For 5% and 80% with a known error, the sum of the quantiles is 1.959964 + 0.841621.
    EXPECT_NEAR(golden::detectable_difference(2.0, infinity, 0.05, 0.8), 2.0 * 2.801585, 2e-6);
}

TEST(DetectableScale, IsFoundAsOftenAsAskedFor)
{
    std::mt19937_64 random(4);
    std::gamma_distribution<double> skewed(25.0, 0.04); // mean 1, deviation 0.2
    const auto draw = [&](std::size_t count, double scale) {
        Values values(count);
        for (double& value : values) value = scale * skewed(random);
        return sorted(values);
    };
    constexpr double alpha = 1e-3;
    constexpr double power = 0.9;
    constexpr int trials = 2'000;
    int found = 0;
    for (int i = 0; i < trials; ++i) {
        const Values reference = draw(400, 1.0);
        const double e = golden::detectable_scale(reference, 50.0, alpha, power);
        found += golden::mann_whitney(draw(50, 1.0 + e), reference).p < alpha;
    }
    // Binomial, 4.5 standard deviations (alpha = 7e-6), and 2% for the first-order approximation.
    EXPECT_NEAR(found, power * trials, 4.5 * std::sqrt(power * (1.0 - power) * trials) + 0.02 * trials);
}

TEST(DetectableShift, OfValuesNearOneIsTheirDetectableScale)
{
    std::mt19937_64 random(7);
    Values reference(500);
    for (double& value : reference) value = std::normal_distribution<double>(1.0, 0.01)(random);
    reference = sorted(reference);
    const double scale = golden::detectable_scale(reference, 50.0, 1e-4, 0.99);
    // Both are computed to 2%. Adding e and multiplying by 1 + e differ by the standard deviation, 1%.
    EXPECT_NEAR(golden::detectable_shift(reference, 50.0, 1e-4, 0.99), scale, 0.05 * scale);
}

TEST(DetectableScale, IsInfiniteWhereNoResultWouldBeSignificant)
{
    const Values reference = {1.0, 2.0, 3.0};
    EXPECT_EQ(golden::detectable_scale(reference, 3.0, 1e-4, 0.99), infinity);
    EXPECT_EQ(golden::detectable_scale({}, 3.0, 1e-4, 0.99), infinity);
    EXPECT_EQ(golden::detectable_scale(reference, 0.0, 1e-4, 0.99), infinity);
}

TEST(DetectableScale, OfNoiselessSamplesIsAlmostNothing)
{
    EXPECT_LE(golden::detectable_scale(Values(512, 1.0), 64.0, 1e-4, 0.99), 1e-9);
}

} // namespace
