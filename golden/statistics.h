#pragma once

// Statistical tests and intervals for samples of numbers. Quantiles and tails of the distributions are
// those of Boost.Math.

#include <span>

namespace golden {

/// Moments of a sample. Of fewer than two values the variance, and of constant ones the skewness, is 0.
struct Moments {
    double count = 0.0;
    double mean = 0.0;
    double variance = 0.0; // with count - 1 in the denominator
    double skewness = 0.0; // third central moment / second^(3/2), both with count in the denominator
};

Moments moments(std::span<const double> values);

/// The moments of all values of several samples together, from those of each [Chan et al. 1983; Pebay
/// 2008]: equal to `moments` of the joined samples to within rounding.
Moments pooled(std::span<const Moments> samples);

/// A two-sided test. z is the standardised effect: positive where the first sample is the larger one.
struct TestResult {
    double z = 0.0;
    double p = 1.0; // chance of an effect at least as large, of either sign, if there is none
};

/// The p-value of the same test when only an effect of the sign of `direction` counts.
double one_sided(const TestResult& test, double direction);

/// Does one sample tend to be larger than the other? The rank sum test [Wilcoxon 1945; Mann & Whitney
/// 1947]. It uses only the order of the values, so it is valid for any tails. Both samples sorted in
/// ascending order; `shift` is added to each value of `a`. The exact distribution of U where there are
/// no ties and |a| |b| <= 400; otherwise the normal approximation with correction for ties and for
/// continuity. Samples that are empty, or all values alike: p = 1. Throws std::invalid_argument for
/// samples that are not sorted.
TestResult mann_whitney(std::span<const double> a, std::span<const double> b, double shift = 0.0);

/// The same for the hypothesis that `a` is shifted against `b` by no more than `tolerance` >= 0, the
/// difference that rounding makes between two implementations of one estimator.
TestResult mann_whitney_beyond(std::span<const double> a, std::span<const double> b, double tolerance);

/// A mean, the variance of its error, and the degrees of freedom of this variance.
struct MeanEstimate {
    double mean = 0.0;
    double variance = 0.0;
    double degrees = 0.0; // > 0; infinite if the variance is known exactly
};

/// The mean of a sample. Needs two values at least: throws std::invalid_argument for fewer.
MeanEstimate mean_estimate(const Moments& moments);

/// Degrees of freedom of the difference of two means [Welch 1947; Satterthwaite 1946]; infinite if
/// neither has an error.
double welch_degrees(const MeanEstimate& a, const MeanEstimate& b);

/// Do two means differ by more than `tolerance` >= 0? [Welch 1947]. Where neither has an error, p is 1
/// or 0.
TestResult welch(const MeanEstimate& a, const MeanEstimate& b, double tolerance = 0.0);

struct Interval {
    double low = 0.0;
    double high = 0.0;
};

/// Confidence interval of a.mean / b.mean [Fieller 1954], for independent means and 0 < confidence < 1.
/// The whole line if b.mean cannot be told from 0 at this confidence.
Interval ratio_interval(const MeanEstimate& a, const MeanEstimate& b, double confidence);

/// The p-value of the smallest of `comparisons` p-values, whatever their dependence [Bonferroni 1936].
double bonferroni(double p, double comparisons);

/// The chance that several samples all exceed the same reference sample significantly, each at its own
/// one-sided level, if all values have the same normal distribution. `counts`, `reference_count`:
/// numbers of values. For a reference without error it is the product of the levels; the error of the
/// reference is common to all samples.
double all_exceed(std::span<const double> counts, std::span<const double> levels,
                  double reference_count);

/// The difference that a two-sided t test at level `alpha` finds with probability `power`, if the
/// difference is measured with this standard error. To first order: both quantiles are Student's.
double detectable_difference(double standard_error, double degrees, double alpha, double power);

/// The smallest effect e > 0 that mann_whitney at level `alpha` finds with probability `power` between
/// `count` values and `reference`, if it multiplies the values of `reference` by 1 + e.
/// Infinite if there is none below 100, for example where even complete separation does not reach the
/// level. `reference` must be sorted and have a positive mean.
double detectable_scale(std::span<const double> reference, double count, double alpha, double power);

/// The same for an effect that adds e to each value.
double detectable_shift(std::span<const double> reference, double count, double alpha, double power);

} // namespace golden
