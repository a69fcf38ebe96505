#include "golden/rare_events.h"

#include "golden/weighted_pixels.h"

#include <algorithm>
#include <cmath>

namespace golden {

namespace {

/// An event of another estimator, beside the golden's.
constexpr double times_as_large = 4.0;

} // namespace

bool lacks_rare_events(const Golden& golden, const Finding& finding)
{
    constexpr double far_too_small = 0.1;
    const auto c = static_cast<int>(finding.channel);
    const Pilot& pilot = golden.functionals.pilot();
    const auto before = static_cast<double>(pilot.batches);
    const auto after = static_cast<double>(golden.reference.size());
    const double all = before + after;
    double with_pilot = 0.0;
    double without = 0.0;
    for_each_pixel(
        golden.functionals, finding.functional, finding.channel, [&](std::size_t i, double weight) {
            // The squared deviations of all batches are those of both parts from their own means, and
            // those of the means [Chan et al. 1983, eq. 1.5].
            const double error = golden.standard_error.pixels[i][c];
            const double deviation = pilot.noise.pixels[i][c] * pilot.mean.pixels[i][c];
            const double distance = (pilot.mean.pixels[i][c] - golden.mean.pixels[i][c]) * all / after;
            const double squares = error * error * all * (all - 1.0);
            const double others =
                deviation * deviation * (before - 1.0) + distance * distance * before * after / all;
            with_pilot += weight * weight * squares / (all - 1.0);
            without += weight * weight * std::max(0.0, squares - others) / std::max(1.0, after - 1.0);
        });
    return without < far_too_small * with_pilot;
}

double largest_unseen_event(const Moments& pictures, const Moments& reference, double largest)
{
    constexpr double far_less = 0.01; // variance
    return pictures.variance < far_less * reference.variance
               ? times_as_large * (largest - reference.mean)
               : 0.0;
}

double largest_unseen_event(const Golden& golden, const Finding& finding, const Moments& pictures,
                            double samples, const Moments& reference, double largest)
{
    const double batch_size = batch_size_of(golden);
    const double batches_in_picture = samples > 0.0 && batch_size > 0.0 ? samples / batch_size : 1.0;
    Moments of_batches = pictures; // the noise of as many samples as in a batch
    of_batches.variance *= batches_in_picture;
    const double of_functional = largest_unseen_event(of_batches, reference, largest);
    if (of_functional == 0.0) return 0.0;
    const auto c = static_cast<int>(finding.channel);
    const auto batches =
        static_cast<double>(golden.functionals.pilot().batches + golden.reference.size());
    double error = 0.0; // the largest of a pixel's share
    for_each_pixel(golden.functionals, finding.functional, finding.channel,
                   [&](std::size_t i, double weight) {
                       error = std::max(error, weight * golden.standard_error.pixels[i][c]);
                   });
    return std::min(of_functional, times_as_large * error * std::sqrt(batches * (batches - 1.0))) /
           batches_in_picture;
}

double least_p_of_darkness(double largest_event, double pictures, const MeanEstimate& candidate,
                           const MeanEstimate& expected, double tolerance)
{
    const double missing = expected.mean - candidate.mean - tolerance;
    if (!(largest_event > 0.0) || !(missing > 0.0)) return 0.0;
    const double per_light = pictures / largest_event; // events in all pictures, per light that they add
    const double variance = candidate.variance + expected.variance;
    if (missing <= variance * per_light) return 0.0; // more likely by noise alone
    const double chance = std::exp(per_light * (0.5 * variance * per_light - missing));
    return std::min(1.0, 2.0 * chance);
}

double hidden_light(double largest_event, double pictures, double level)
{
    return -largest_event * std::log(level) / pictures;
}

QuietPixels quiet_pixels(const Golden& golden, const Finding& finding,
                         const images::BatchMoments& moments, double pictures, double rounding,
                         double brightness)
{
    const auto c = static_cast<int>(finding.channel);
    QuietPixels quiet;
    quiet.pictures = pictures;
    for_each_pixel(golden.functionals, finding.functional, finding.channel,
                   [&](std::size_t i, double weight) {
                       const double own = golden.mean.pixels[i][c];
                       const double by_rounding = rounding * (own > 0.0 ? own : brightness);
                       const double further = moments.mean.pixels[i][c] - own;
                       const double scatter = std::sqrt(moments.squares.pixels[i][c] / quiet.pictures);
                       if (std::abs(further) <= by_rounding || scatter > by_rounding ||
                           golden.standard_error.pixels[i][c] > by_rounding)
                           return;
                       ++quiet.pixels;
                       quiet.difference += weight * further;
                   });
    return quiet;
}

double least_p(const QuietPixels& quiet, const MeanEstimate& candidate, const MeanEstimate& expected,
               double tolerance)
{
    if (quiet.pixels == 0.0) return 0.0;
    const MeanEstimate others{candidate.mean - quiet.difference, candidate.variance, candidate.degrees};
    // Whatever the chance of an event, a picture contains it exactly once with a chance of at most 1/e
    // (Poisson), and any other number of times with less. Each pixel has events of its own.
    const double coincidence = std::exp(-quiet.pictures * quiet.pixels);
    return std::min(coincidence, welch(others, expected, tolerance).p);
}

} // namespace golden
