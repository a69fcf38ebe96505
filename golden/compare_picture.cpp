// A single picture of unknown noise.

#include "golden/compare.h"
#include "golden/judge.h"
#include "golden/reason.h"
#include "golden/scatter.h"
#include "golden/verdict.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace golden {

namespace {

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
    const images::BatchMoments alone{picture, images::Image(picture.width, picture.height)};
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
            const PictureEstimate estimate =
                picture_estimate(scatter(golden, picture, f, c), values_of(row, functionals, f, c)[0],
                                 reference, batches);
            comparison.findings.push_back(judge.judge(estimate.value, estimate.skewed, f, c, alone));
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
