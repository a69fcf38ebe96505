#include "golden/judge.h"

#include "golden/pixel_noise.h"
#include "golden/rare_events.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace golden {

namespace {

constexpr double not_defined = std::numeric_limits<double>::quiet_NaN();
constexpr double without_end = std::numeric_limits<double>::infinity();
constexpr MeanEstimate known_zero{0.0, 0.0, without_end};

} // namespace

Judge::Judge(const Golden& golden, Method method, const CompareOptions& options)
    : golden_(golden), functionals_(golden.functionals), method_(method), options_(options),
      multiplicity_(functionals_, method)
{
    for (const images::Rgb& pixel : golden.mean.pixels)
        brightness_ +=
            (pixel.r + pixel.g + pixel.b) / (3.0 * static_cast<double>(golden.mean.pixels.size()));
}

bool Judge::can_test(std::size_t functional) const
{
    return method_ == Method::ranks || is_linear(functionals_.at(functional).weight);
}

Finding Judge::judge(const Candidate& candidate, std::size_t functional, std::size_t channel) const
{
    Finding finding = blank(functional, channel);
    std::vector<double> ours = values_of(candidate.rows(), functionals_, functional, channel);
    std::vector<double> theirs = values_of(golden_.reference, functionals_, functional, channel);
    const Moments pictures = moments(ours);
    const Moments reference = moments(theirs);
    if (method_ == Method::welch) {
        judge_by_means(finding, candidate, pictures, reference,
                       *std::max_element(theirs.begin(), theirs.end()));
        return finding;
    }
    std::sort(ours.begin(), ours.end());
    std::sort(theirs.begin(), theirs.end());
    finding.test = mann_whitney_beyond(ours, theirs, options_.rounding * std::abs(reference.mean));
    finding.detectable = detectable_by_ranks(finding, theirs, pictures.count);
    if (pictures.count >= 2.0 && reference.count >= 2.0)
        finish(finding, mean_estimate(pictures), mean_estimate(reference));
    else
        finding.certain_p = finding.adjusted_p =
            bonferroni(finding.test.p, multiplicity_.of(finding.region.kind));
    return finding;
}

/// `largest`: of the golden's batches.
void Judge::judge_by_means(Finding& finding, const Candidate& candidate, const Moments& pictures,
                           const Moments& reference, double largest) const
{
    const PixelNoise pixels = pixel_noise(candidate, finding.functional, finding.channel);
    const MeanEstimate estimate = moderated(pictures, pixels);
    const double event =
        largest_unseen_event(golden_, finding, pictures, options_.picture_samples, reference, largest);
    compare_means(finding, estimate, reference, mean_skewness(pictures, pixels, reference),
                  pictures.count, event);
    const MeanEstimate expected = mean_estimate(reference);
    const double tolerance = options_.rounding * size_of(finding, expected.mean);
    const double least =
        std::max(least_p_of(finding, estimate, expected, candidate.moments(), pictures.count),
                 least_p_of_darkness(event, pictures.count, estimate, expected, tolerance));
    finding.test.p = std::max(finding.test.p, least);
    finding.darker_by_means = reference.variance > 0.0 && finding.test.z < 0.0;
    finish(finding, estimate, expected);
    // Welch's degrees follow the variances that are found. That of few values is far too small in one of
    // a thousand tests, just by chance; then all noise seems to be the golden's, with its many degrees.
    // With the variance of many pixels beside it this cannot happen. Else the smaller number of degrees
    // counts, which is never too many [Hsu 1938].
    if (finding.conclusive && estimate.degrees - (pictures.count - 1.0) < pixel_degrees) {
        const MeanEstimate careful{finding.test.z, 1.0, std::min(estimate.degrees, expected.degrees)};
        finding.certain_p = bonferroni(std::max(least, welch(careful, known_zero).p),
                                       multiplicity_.of(finding.region.kind));
    }
}

Finding Judge::judge(const MeanEstimate& candidate, double skewed, std::size_t functional,
                     std::size_t channel, const images::BatchMoments& picture) const
{
    Finding finding = blank(functional, channel);
    const Moments reference = moments(values_of(golden_.reference, functionals_, functional, channel));
    compare_means(finding, candidate, reference, skewed, 1.0);
    const MeanEstimate expected = mean_estimate(reference);
    finding.test.p = std::max(finding.test.p, least_p_of(finding, candidate, expected, picture, 1.0));
    finish(finding, candidate, expected);
    return finding;
}

Finding Judge::compared(const MeanEstimate& candidate, std::size_t functional, std::size_t channel) const
{
    Finding finding = blank(functional, channel);
    const Moments reference = moments(values_of(golden_.reference, functionals_, functional, channel));
    compare_means(finding, candidate, reference, 0.0, 1.0);
    return finding;
}

std::optional<double> Judge::adjusted_p(const MeanEstimate& candidate, double skewed,
                                        const Moments& reference, std::size_t functional,
                                        std::size_t channel) const
{
    const Finding finding = blank(functional, channel);
    const double golden_skewed = std::abs(reference.skewness) / std::sqrt(reference.count);
    if (std::max(skewed, golden_skewed) > options_.skewness) return std::nullopt;
    const MeanEstimate expected = mean_estimate(reference);
    const double tolerance = options_.rounding * size_of(finding, expected.mean);
    return bonferroni(welch(candidate, expected, tolerance).p, multiplicity_.of(finding.region.kind));
}

Finding Judge::blank(std::size_t functional, std::size_t channel) const
{
    const Functional f = functionals_.at(functional);
    return {
        functionals_.regions()[f.region], f.weight,   functional, channel, true, {}, 1.0, not_defined,
        {not_defined, not_defined},       not_defined};
}

double Judge::detectable(std::size_t functional, std::size_t channel, double batches) const
{
    std::vector<double> values = values_of(golden_.reference, functionals_, functional, channel);
    std::sort(values.begin(), values.end());
    return detectable_by_ranks(blank(functional, channel), values, batches);
}

double Judge::detectable_by_ranks(const Finding& finding, const std::vector<double>& reference,
                                  double count) const
{
    const double level = level_of(finding);
    if (is_linear(finding.weight))
        return moments(reference).mean > 0.0 ? detectable_scale(reference, count, level, options_.power)
                                             : not_defined;
    const std::size_t at = finding.channel * functionals_.size() + finding.functional;
    const double slope = static_cast<double>(golden_.slopes[at]) *
                         functionals_.spread(finding.functional, finding.channel);
    // To first order in the error.
    return slope > 0.0 ? detectable_shift(reference, count, level, options_.power) / slope : not_defined;
}

double Judge::level_of(const Finding& finding) const
{
    return options_.suspicion_level / multiplicity_.of(finding.region.kind);
}

double Judge::least_p_of(const Finding& finding, const MeanEstimate& estimate,
                         const MeanEstimate& expected, const images::BatchMoments& moments,
                         double pictures) const
{
    const QuietPixels quiet =
        quiet_pixels(golden_, finding, moments, pictures, options_.rounding, brightness_);
    return least_p(quiet, estimate, expected, options_.rounding * size_of(finding, expected.mean));
}

void Judge::compare_means(Finding& finding, const MeanEstimate& candidate, const Moments& reference,
                          double skewed, double pictures, double largest_event) const
{
    const double golden_skewed = std::abs(reference.skewness) / std::sqrt(reference.count);
    const bool golden_lacks_events = lacks_rare_events(golden_, finding);
    finding.conclusive = std::max(skewed, golden_skewed) <= options_.skewness && !golden_lacks_events;
    const MeanEstimate expected = mean_estimate(reference);
    finding.test = welch(candidate, expected, options_.rounding * size_of(finding, expected.mean));
    // Two-sided, as the level is, and only darkness can be the lack of events.
    if (expected.mean > 0.0)
        finding.hidden = hidden_light(largest_event, pictures, level_of(finding) / 2.0) / expected.mean;
    if (finding.conclusive && expected.mean > 0.0)
        finding.detectable =
            finding.hidden + detectable_difference(std::sqrt(candidate.variance + expected.variance),
                                                   welch_degrees(candidate, expected), level_of(finding),
                                                   options_.power) /
                                 expected.mean;
    if (expected.mean > 0.0 && finding.region.kind == RegionKind::whole)
        finding.reach =
            reach_of(finding, candidate, expected, skewed, golden_skewed, pictures, golden_lacks_events);
}

double Judge::size_of(const Finding& finding, double mean) const
{
    if (mean != 0.0) return std::abs(mean);
    // Where the golden is black the functional is a plain sum. A conversion between colour spaces leaves
    // rounding errors there, in proportion to the brightness of the picture.
    return brightness_ * static_cast<double>(finding.region.pixels);
}

Reach Judge::reach_of(const Finding& finding, const MeanEstimate& candidate,
                      const MeanEstimate& expected, double skewed, double golden_skewed, double pictures,
                      bool golden_lacks_events) const
{
    const double level = level_of(finding);
    // The smallest relative error that is detectable if the difference has standard error 1.
    const auto unit = [&](double degrees) {
        return detectable_difference(1.0, degrees, level, options_.power) / expected.mean;
    };
    const auto allowed = [&](double degrees) { // variance of the difference
        return std::pow(options_.specification / unit(degrees), 2.0);
    };
    const double room = allowed(expected.degrees);
    const bool not_usable = golden_lacks_events || golden_skewed > options_.skewness;
    Reach reach;
    reach.limit = not_usable ? without_end : std::sqrt(expected.variance) * unit(expected.degrees);
    reach.golden =
        std::max(2.0 * expected.variance / room, std::pow(golden_skewed / options_.skewness, 2.0));
    // The mean of n equal events has the skewness 1 / sqrt(n). One is known, in the pilot.
    if (golden_lacks_events) reach.golden = std::max(reach.golden, std::pow(options_.skewness, -2.0));
    reach.candidate = without_end;
    if (not_usable || !(room > expected.variance)) return reach;
    // With the number of batches B, variances fall as 1 / B and |skewness| / sqrt(B) as 1 / sqrt(B). The
    // degrees of freedom grow with the number of pictures; those of one picture's pixels stay. The light
    // that may be hidden falls as 1 / B.
    const auto enough = [&](double factor) {
        const double degrees = method_ == Method::welch
                                   ? std::max(1.0, candidate.degrees + pictures * (factor - 1.0))
                                   : candidate.degrees;
        const MeanEstimate more{candidate.mean, candidate.variance / factor, degrees};
        const double noise = std::sqrt(more.variance + expected.variance);
        return noise * unit(welch_degrees(more, expected)) + finding.hidden / factor <=
               options_.specification;
    };
    constexpr double smallest = 1e-12;
    constexpr double largest = 1e12;
    // Enough with the largest possible number of degrees: the search begins here.
    double factor = std::max({smallest, candidate.variance / (room - expected.variance),
                              finding.hidden / options_.specification});
    while (factor < largest && !enough(factor)) factor *= 1.1;
    reach.candidate = std::max(factor, std::pow(skewed / options_.skewness, 2.0));
    return reach;
}

void Judge::finish(Finding& finding, const MeanEstimate& candidate, const MeanEstimate& reference) const
{
    if (finding.conclusive)
        finding.certain_p = finding.adjusted_p =
            bonferroni(finding.test.p, multiplicity_.of(finding.region.kind));
    // A golden that is black after its pilot: rows are rounded, so the mean is not quite 0.
    constexpr double black = 1e-9;
    if (std::abs(reference.mean) < black) return;
    finding.ratio = candidate.mean / reference.mean;
    finding.interval = ratio_interval(candidate, reference, options_.confidence);
}

} // namespace golden
