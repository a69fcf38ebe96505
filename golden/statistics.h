#pragma once

// The statistics that pictures are judged by: samples of numbers in, p-values and intervals out.
// Quantiles and tails of the distributions are Boost.Math's.

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

/// A two-sided test. z is the standardised effect: positive where the first sample is the larger one.
struct TestResult {
    double z = 0.0;
    double p = 1.0; // chance of an effect at least as large, of either sign, if there is none
};

/// The p-value of the same test when only an effect of the sign of `direction` counts.
double one_sided(const TestResult& test, double direction);

/// Does one sample tend to be larger than the other? The rank sum test [Wilcoxon 1945; Mann & Whitney
/// 1947]: it looks only at which value is larger, so no tail is too heavy for it. Both samples sorted in
/// ascending order; `shift` is added to each value of `a`. The exact distribution of U where there are
/// no ties and |a| |b| <= 400; otherwise the normal approximation with correction for ties and for
/// continuity. Samples that are empty, or all values alike: p = 1. Throws std::invalid_argument for
/// samples that are not sorted.
TestResult mann_whitney(std::span<const double> a, std::span<const double> b, double shift = 0.0);

/// The same for the hypothesis that `a` differs from `b` by no more than `tolerance` >= 0, which is what
/// is left of a difference between implementations of the same thing once they round differently.
TestResult mann_whitney_beyond(std::span<const double> a, std::span<const double> b, double tolerance);

/// A mean with the variance of its error and the degrees of freedom that this variance is known with.
struct MeanEstimate {
    double mean = 0.0;
    double variance = 0.0;
    double degrees = 0.0; // > 0; infinite for a variance that is known
};

/// The mean of a sample. Needs two values at least: throws std::invalid_argument for fewer.
MeanEstimate mean_estimate(const Moments& moments);

/// Degrees of freedom of the difference of two means [Welch 1947; Satterthwaite 1946]; infinite if
/// neither has an error.
double welch_degrees(const MeanEstimate& a, const MeanEstimate& b);

/// Do two means differ by more than `tolerance` >= 0? [Welch 1947]. Where neither has an error, p is 1
/// or 0.
TestResult welch(const MeanEstimate& a, const MeanEstimate& b, double tolerance = 0.0);

/// Whether `candidate`, of values >= 0, may be darker than `reference` only because none of its batches
/// has an event that is rare for it: neither its variance nor its skewness then shows that there are
/// such events. It may, if both hold:
/// - its standard deviation is less than a tenth of the reference's, which has seen the events;
/// - events that all of its B batches lack with a probability of `level`, (1 - q)^B = level, can bring
///   what is missing: each has to bring missing / q, and that is at most four times what the `largest`
///   value of the reference is above its mean.
/// So light that is missing for good where the reference has little noise is not taken for bad luck.
bool may_lack_rare_events(const Moments& candidate, const Moments& reference, double largest,
                          double level);

struct Interval {
    double low = 0.0;
    double high = 0.0;
};

/// Confidence interval of a.mean / b.mean [Fieller 1954], for independent means and 0 < confidence < 1.
/// The whole line if b.mean cannot be told from 0 at this confidence.
Interval ratio_interval(const MeanEstimate& a, const MeanEstimate& b, double confidence);

/// The p-value of the smallest of `comparisons` p-values, whatever their dependence [Bonferroni 1936].
double bonferroni(double p, double comparisons);

/// The chance that all of several samples exceed one and the same reference sample, each significantly
/// at its own one-sided level, if all are alike: by `counts` normally distributed values each, and
/// `reference_count`. Were the reference known exactly, it would be the product of the levels; its error
/// is shared by all.
double all_exceed(std::span<const double> counts, std::span<const double> levels,
                  double reference_count);

/// The difference that a two-sided t test at level `alpha` finds with probability `power`, if the
/// difference is measured with this standard error. To first order: both quantiles are Student's.
double detectable_difference(double standard_error, double degrees, double alpha, double power);

/// The smallest effect e > 0 that mann_whitney at level `alpha` finds with probability `power` between
/// `count` values and `reference`, if it turns the distribution of `reference` into that of
/// (1 + e) `reference`: such values must exceed those of `reference` often enough. Infinite if there is
/// none below 100, as is the case if even complete separation would not reach the level. `reference`
/// sorted, of positive mean.
double detectable_scale(std::span<const double> reference, double count, double alpha, double power);

/// The same for an effect that adds e to each value.
double detectable_shift(std::span<const double> reference, double count, double alpha, double power);

} // namespace golden
