#include "golden/statistics.h"

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace golden {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Boost computes in long double by default, which takes several times as long. The relative error of
/// a tail in double, some 1e-14, changes no verdict.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using Student = boost::math::students_t_distribution<double, InDouble>;

/// The chance that a standard normal variable exceeds z.
double normal_tail(double z)
{
    return boost::math::cdf(boost::math::complement(boost::math::normal(), z));
}

/// The value that a standard normal variable exceeds with this chance.
double normal_quantile(double tail)
{
    return boost::math::quantile(boost::math::complement(boost::math::normal(), tail));
}

double student_tail(double degrees, double t)
{
    if (std::isinf(t)) return 0.0;
    return std::isinf(degrees) ? normal_tail(t)
                               : boost::math::cdf(boost::math::complement(Student(degrees), t));
}

double student_quantile(double degrees, double tail)
{
    return std::isinf(degrees) ? normal_quantile(tail)
                               : boost::math::quantile(boost::math::complement(Student(degrees), tail));
}

/// Counts from the merge of two sorted samples.
struct Ranks {
    double u = 0.0;    // pairs with a > b, those with a = b counted half
    double ties = 0.0; // sum of t^3 - t over the groups of t equal values
};

Ranks rank(std::span<const double> a, std::span<const double> b, double shift)
{
    Ranks ranks;
    std::size_t j = 0;
    for (std::size_t i = 0; i < a.size();) {
        const double value = a[i] + shift;
        std::size_t equal_a = 0;
        while (i < a.size() && a[i] + shift == value) ++i, ++equal_a;
        // Ties among the values of b that lie between those of a count as well.
        while (j < b.size() && b[j] < value) {
            const std::size_t first = j;
            while (j < b.size() && b[j] == b[first]) ++j;
            const auto t = static_cast<double>(j - first);
            ranks.ties += t * t * t - t;
        }
        const std::size_t below = j;
        while (j < b.size() && b[j] == value) ++j;
        const auto equal_b = static_cast<double>(j - below);
        ranks.u += static_cast<double>(equal_a) * (static_cast<double>(below) + 0.5 * equal_b);
        const double t = static_cast<double>(equal_a) + equal_b;
        ranks.ties += t * t * t - t;
    }
    while (j < b.size()) {
        const std::size_t first = j;
        while (j < b.size() && b[j] == b[first]) ++j;
        const auto t = static_cast<double>(j - first);
        ranks.ties += t * t * t - t;
    }
    return ranks;
}

/// In how many ways n values of one kind and m of another can be arranged for each U in 0..n m: the
/// coefficients of the Gaussian binomial, product over i of (1 - q^(m+i)) / (1 - q^i).
/// [Mann & Whitney 1947]
std::vector<double> arrangements(std::size_t n, std::size_t m)
{
    std::vector<double> ways(n * m + 1, 0.0);
    ways[0] = 1.0;
    for (std::size_t i = 1; i <= n; ++i) {
        for (std::size_t u = ways.size(); u-- > m + i;) ways[u] -= ways[u - m - i];
        for (std::size_t u = i; u < ways.size(); ++u) ways[u] += ways[u - i];
    }
    return ways;
}

/// 2 min(P(U <= u), P(U >= u)) if all arrangements are equally likely.
double exact_p(std::size_t n, std::size_t m, double u)
{
    const std::vector<double> ways = arrangements(n, m);
    const double extreme = std::min(u, static_cast<double>(n * m) - u); // the distribution is symmetric
    double tail = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        all += ways[i];
        if (static_cast<double>(i) <= extreme) tail += ways[i];
    }
    return std::min(1.0, 2.0 * tail / all);
}

/// The smallest effect that is found often enough. change(value, e) is what an effect makes of a value;
/// to first order it moves the mean by e `slope`.
template <class Change>
double detectable_effect(std::span<const double> reference, double count, double alpha, double power,
                         double slope, const Change& change)
{
    const auto m = static_cast<double>(reference.size());
    if (reference.empty() || !(count > 0.0)) return infinity;
    // By how much P(larger) + P(equal) / 2 must exceed 1/2.
    const double needed = (normal_quantile(alpha / 2.0) + normal_quantile(1.0 - power)) *
                          std::sqrt((count + m + 1.0) / (12.0 * count * m));
    if (needed >= 0.5) return infinity;
    std::vector<double> changed(reference.size());
    const auto excess = [&](double e) {
        std::transform(reference.begin(), reference.end(), changed.begin(),
                       [&](double value) { return change(value, e); });
        return rank(changed, reference, 0.0).u / (m * m) - 0.5;
    };
    // For a normal distribution the excess is e slope / (2 sqrt(pi) sigma) to first order: begin there.
    constexpr double smallest = 1e-12; // of samples without noise
    constexpr double largest = 100.0;
    const double sigma = std::sqrt(moments(reference).variance);
    double high =
        std::clamp(needed * 2.0 * std::sqrt(std::numbers::pi) * sigma / slope, smallest, largest);
    // Mostly the excess grows in proportion, and two or three steps lead there.
    for (int step = 0; step < 4; ++step) {
        const double found = excess(high);
        if (found >= needed && found <= 1.02 * needed) return high;
        if (found < 0.25 * needed || found > 4.0 * needed) break;
        high = std::clamp(high * 1.01 * needed / found, smallest, largest);
    }
    double low = high;
    while (excess(high) < needed) {
        if (high >= largest) return infinity;
        low = high;
        high *= 1.25;
    }
    while (low == high || excess(low) >= needed) {
        if (low <= smallest) return high;
        high = low;
        low /= 1.25;
    }
    while (high - low > 0.02 * high) { // two digits: another golden changes more
        const double middle = (low + high) / 2.0;
        (excess(middle) >= needed ? high : low) = middle;
    }
    return high;
}

} // namespace

Moments moments(std::span<const double> values)
{
    Moments result;
    result.count = static_cast<double>(values.size());
    if (values.empty()) return result;
    // A rounded mean of equal values would differ from all of them by the same error, a skewness of 1 or
    // -1.
    if (std::ranges::all_of(values, [&](double value) { return value == values.front(); })) {
        result.mean = values.front();
        return result;
    }
    for (const double value : values) result.mean += value;
    result.mean /= result.count;
    double squares = 0.0;
    double cubes = 0.0;
    for (const double value : values) {
        const double d = value - result.mean;
        squares += d * d;
        cubes += d * d * d;
    }
    if (values.size() > 1) result.variance = squares / (result.count - 1.0);
    const double second = squares / result.count;
    const double cubed = second * std::sqrt(second);
    if (cubed > 0.0) result.skewness = cubes / result.count / cubed;
    return result;
}

Moments pooled(std::span<const Moments> samples)
{
    Moments result;
    double sum = 0.0;
    for (const Moments& sample : samples) {
        result.count += sample.count;
        sum += sample.count * sample.mean;
    }
    if (result.count == 0.0) return result;
    result.mean = sum / result.count;
    double squares = 0.0; // sums of (value - mean)^2 and (value - mean)^3 about the common mean
    double cubes = 0.0;
    for (const Moments& sample : samples) {
        const double n = sample.count;
        const double d = sample.mean - result.mean;
        const double own_squares = sample.variance * std::max(0.0, n - 1.0);
        const double second = n > 0.0 ? own_squares / n : 0.0;
        const double own_cubes = sample.skewness * second * std::sqrt(second) * n;
        squares += own_squares + n * d * d;
        cubes += own_cubes + 3.0 * d * own_squares + n * d * d * d;
    }
    if (result.count > 1.0) result.variance = squares / (result.count - 1.0);
    const double second = squares / result.count;
    const double cubed = second * std::sqrt(second);
    if (cubed > 0.0) result.skewness = cubes / result.count / cubed;
    return result;
}

double one_sided(const TestResult& test, double direction)
{
    if (test.z == 0.0) return 1.0;
    return (test.z > 0.0) == (direction > 0.0) ? test.p / 2.0 : 1.0 - test.p / 2.0;
}

TestResult mann_whitney(std::span<const double> a, std::span<const double> b, double shift)
{
    if (!std::is_sorted(a.begin(), a.end()) || !std::is_sorted(b.begin(), b.end()))
        throw std::invalid_argument("Mann-Whitney: the samples are not sorted");
    if (a.empty() || b.empty()) return {};
    const auto n = static_cast<double>(a.size());
    const auto m = static_cast<double>(b.size());
    const Ranks ranks = rank(a, b, shift);
    const double from_middle = ranks.u - n * m / 2.0;
    const double all = n + m;
    const double variance = n * m / 12.0 * (all + 1.0 - ranks.ties / (all * (all - 1.0)));
    if (!(variance > 0.0) || from_middle == 0.0) return {};
    // U moves in steps of 1, or of 1/2 with ties: half a step of 1 is taken off.
    const double distance = std::max(0.0, std::abs(from_middle) - 0.5);
    TestResult result;
    result.z = std::copysign(distance / std::sqrt(variance), from_middle);
    constexpr double small = 400.0; // 20 x 20: all counts of arrangements are exact in double
    result.p = ranks.ties == 0.0 && n * m <= small ? exact_p(a.size(), b.size(), ranks.u)
                                                   : 2.0 * normal_tail(std::abs(result.z));
    return result;
}

TestResult mann_whitney_beyond(std::span<const double> a, std::span<const double> b, double tolerance)
{
    const TestResult lowered = mann_whitney(a, b, -tolerance);
    if (lowered.z > 0.0) return lowered;
    const TestResult raised = mann_whitney(a, b, tolerance);
    return raised.z < 0.0 ? raised : TestResult{};
}

MeanEstimate mean_estimate(const Moments& moments)
{
    if (moments.count < 2.0) throw std::invalid_argument("one value says nothing about its error");
    return {moments.mean, moments.variance / moments.count, moments.count - 1.0};
}

double welch_degrees(const MeanEstimate& a, const MeanEstimate& b)
{
    const double sum = a.variance + b.variance;
    if (!(sum > 0.0)) return infinity;
    const double share_a = a.variance / sum; // shares: squares of small variances may underflow
    const double share_b = b.variance / sum;
    return 1.0 / (share_a * share_a / a.degrees + share_b * share_b / b.degrees);
}

TestResult welch(const MeanEstimate& a, const MeanEstimate& b, double tolerance)
{
    const double difference = a.mean - b.mean;
    const double beyond = std::abs(difference) - tolerance;
    if (!(beyond > 0.0)) return {};
    const double t = beyond / std::sqrt(a.variance + b.variance);
    return {std::copysign(t, difference), std::min(1.0, 2.0 * student_tail(welch_degrees(a, b), t))};
}

Interval ratio_interval(const MeanEstimate& a, const MeanEstimate& b, double confidence)
{
    // All r for which a - r b is not significantly different from 0: a quadratic in r.
    const double t = student_quantile(welch_degrees(a, b), (1.0 - confidence) / 2.0);
    const double known = b.mean * b.mean - t * t * b.variance;
    if (!(known > 0.0)) return {-infinity, infinity};
    const double middle = a.mean * b.mean / known;
    const double constant = (a.mean * a.mean - t * t * a.variance) / known;
    const double half = std::sqrt(std::max(0.0, middle * middle - constant));
    return {middle - half, middle + half};
}

double bonferroni(double p, double comparisons)
{
    return std::min(1.0, p * comparisons);
}

double all_exceed(std::span<const double> counts, std::span<const double> levels, double reference_count)
{
    // Given the reference's error r in its own standard deviations, the samples are independent. Over r
    // the trapezoidal rule converges faster than any power of the step, as the integrand is analytic and
    // vanishes with all derivatives at both ends.
    constexpr double reach = 10.0; // beyond it the normal density is below 1e-22
    constexpr double step = 0.05;
    const double reference_error = 1.0 / std::sqrt(reference_count);
    double sum = 0.0;
    for (double r = -reach; r <= reach; r += step) {
        double product = std::exp(-r * r / 2.0) / std::sqrt(2.0 * std::numbers::pi);
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const double error = 1.0 / std::sqrt(counts[i]);
            const double threshold = normal_quantile(levels[i]) * std::hypot(error, reference_error);
            product *= normal_tail((threshold - r * reference_error) / error);
        }
        sum += product * step;
    }
    return sum;
}

double detectable_difference(double standard_error, double degrees, double alpha, double power)
{
    return standard_error *
           (student_quantile(degrees, alpha / 2.0) + student_quantile(degrees, 1.0 - power));
}

double detectable_scale(std::span<const double> reference, double count, double alpha, double power)
{
    return detectable_effect(reference, count, alpha, power, moments(reference).mean,
                             [](double value, double e) { return (1.0 + e) * value; });
}

double detectable_shift(std::span<const double> reference, double count, double alpha, double power)
{
    return detectable_effect(reference, count, alpha, power, 1.0,
                             [](double value, double e) { return value + e; });
}

} // namespace golden
