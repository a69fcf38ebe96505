// A single picture of unknown noise.

#include "golden/compare.h"
#include "golden/judge.h"
#include "golden/reason.h"
#include "golden/verdict.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace golden {

namespace {

/// The noise of a linear functional of a picture, measured from the scatter of its pixels.
struct Scatter {
    double variance;        // of the functional, by the picture's noise alone; may be < 0 by chance
    double error;           // standard error of this variance
    double golden;          // variance by the golden's noise, already subtracted
    double expected;        // variance of one batch of the golden's estimator
    double blocks;          // number of sums over blocks
    double noisy_blocks;    // of those in which the golden has noise
    double blocks_skewness; // of these sums
};

/// Sums the weighted difference from the golden over blocks of up to 4x4 pixels. The scatter of these
/// sums is the noise of the picture plus that of the golden, which its standard errors give. Blocks,
/// because reconstruction filters make neighbouring pixels depend on each other.
Scatter scatter(const Golden& golden, const images::Image& picture, std::size_t functional,
                std::size_t channel)
{
    const Functionals& functionals = golden.functionals;
    const Region& region = functionals.regions()[functionals.at(functional).region];
    const int side = std::clamp(std::max(picture.width, picture.height) / 32, 1, 4);
    const auto c = static_cast<int>(channel);
    std::vector<double> blocks;
    double golden_variance = 0.0;
    double noisy_blocks = 0.0;
    for (int y0 = region.y0; y0 < region.y1; y0 += side)
        for (int x0 = region.x0; x0 < region.x1; x0 += side) {
            double sum = 0.0;
            bool inside = false;
            const double golden_before = golden_variance;
            for (int y = y0; y < std::min(y0 + side, region.y1); ++y)
                for (int x = x0; x < std::min(x0 + side, region.x1); ++x) {
                    const auto i =
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                        static_cast<std::size_t>(x);
                    const double weight = functionals.pixel_weight(functional, channel, i);
                    if (weight == 0.0) continue;
                    inside = true;
                    sum += weight * (picture.pixels[i][c] - golden.mean.pixels[i][c]);
                    const double error = weight * golden.standard_error.pixels[i][c];
                    golden_variance += error * error;
                }
            if (inside) blocks.push_back(sum);
            noisy_blocks += golden_variance > golden_before;
        }
    const Moments found = moments(blocks);
    double fourth = 0.0;
    for (const double sum : blocks) fourth += std::pow(sum - found.mean, 4.0);
    // For normal deviations of variances v_i the sum of squares has variance 2 sum v_i^2, and the sum of
    // fourth powers has mean 3 sum v_i^2.
    return {found.variance * found.count - golden_variance,
            std::sqrt(2.0 / 3.0 * fourth),
            golden_variance,
            golden_variance * static_cast<double>(golden.batches()),
            found.count,
            noisy_blocks,
            found.skewness};
}

/// Throws std::invalid_argument if the picture differs from the golden by less than the golden's own
/// noise: then the two are not independent.
void expect_independent(const Scatter& whole)
{
    constexpr double fewest =
        64.0; // blocks: a quarter of the expected variance then has a chance of 1e-9
    if (whole.noisy_blocks >= fewest && whole.golden > 0.0 &&
        whole.variance + whole.golden < 0.25 * whole.golden)
        throw std::invalid_argument("has the golden's own noise: it is not independent of the golden");
}

/// Sets noise_ratio and noise_error, for the channel in which the ratio is largest.
void measure_noise(Comparison& comparison, const Golden& golden, const images::Image& picture)
{
    constexpr std::size_t whole = 0; // matched
    for (std::size_t c = 0; c < channel_count; ++c) {
        const Scatter shown = scatter(golden, picture, whole, c);
        if (!(shown.expected > 0.0)) continue;
        expect_independent(shown);
        const double assumed = shown.expected / comparison.candidate_batches;
        if (comparison.noise_ratio && shown.variance / assumed <= *comparison.noise_ratio) continue;
        comparison.noise_ratio = shown.variance / assumed;
        comparison.noise_error = shown.error / assumed;
    }
}

/// All findings of a picture and their summary, without a verdict.
Comparison look_at_picture(const Golden& golden, const images::Image& picture, double batches,
                           const CompareOptions& options)
{
    const Functionals& functionals = golden.functionals;
    const std::vector<Row> row = {functionals.evaluate(picture)};
    images::Film film(picture.width, picture.height);
    film.add_batch(picture);
    Comparison comparison;
    comparison.method = Method::picture;
    comparison.golden_batches = golden.reference.size();
    comparison.candidate_batches = batches;
    comparison.batch_size = batch_size_of(golden);
    const Judge judge(golden, Method::picture, options);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t f = 0; f < functionals.size(); ++f) {
            if (!judge.can_test(f)) continue;
            const Moments reference = moments(values_of(golden.reference, functionals, f, c));
            MeanEstimate estimate{values_of(row, functionals, f, c)[0], reference.variance / batches,
                                  reference.count - 1.0};
            double skewed = std::abs(reference.skewness) / std::sqrt(batches);
            const Scatter shown = scatter(golden, picture, f, c);
            if (shown.variance > estimate.variance) {
                estimate.variance = shown.variance;
                // Subtracting the golden's known part keeps the absolute error of the variance, so the
                // relative error grows by 1 / share. Below one degree quantiles overflow.
                const double share = shown.variance / (shown.variance + shown.golden);
                estimate.degrees = std::max(1.0, (shown.blocks - 1.0) * share * share);
                skewed = std::max(skewed, std::abs(shown.blocks_skewness) / std::sqrt(shown.blocks));
            }
            comparison.findings.push_back(judge.judge(estimate, skewed, f, c, film));
        }
    summarise(comparison);
    summarise_reach(comparison, golden, options);
    comparison.false_alarm = options.certainty_level + options.dark_level;
    comparison.stages.push_back({static_cast<std::uint64_t>(std::llround(std::max(1.0, batches))),
                                 comparison.p, options.suspicion_level});
    return comparison;
}

void decide(Comparison& comparison, const CompareOptions& options)
{
    if (decide_at_once(comparison, options)) return;
    comparison.verdict = Verdict::inconclusive;
    give_reason(comparison, "Suspicious: " + say_suspicion(comparison) +
                                ". A second, independent picture must confirm or clear it.");
}

} // namespace

Comparison compare_picture(const Golden& golden, const images::Image& picture, double samples,
                           const CompareOptions& options)
{
    if (!(samples > 0.0)) throw std::invalid_argument("the number of samples must be positive");
    if (golden.reference.size() < 2)
        throw std::invalid_argument("the golden has one batch after its pilot: too few");
    const double batch_size = batch_size_of(golden);
    if (!(batch_size > 0.0)) throw std::invalid_argument("the golden's metadata have no batch_size");
    const double batches = samples / batch_size;
    Comparison comparison = look_at_picture(golden, picture, batches, options);
    comparison.odd = odd_pixels(golden, picture, batches, options.dark_level);
    measure_noise(comparison, golden, replaced(picture, pixels_of(comparison.odd), golden.mean));
    decide(comparison, options);
    const auto bright = bright_pixels(comparison.odd);
    if (comparison.verdict != Verdict::inconclusive || bright.empty()) return comparison;
    Comparison without =
        look_at_picture(golden, replaced(picture, bright, golden.mean), batches, options);
    decide(without, options);
    decide_without(comparison, without, options);
    return comparison;
}

} // namespace golden
