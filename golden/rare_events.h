#pragma once

// Rare events: samples of a pixel that few batches or pictures contain. Where those that are compared
// contain none, or each contains equally many, they have no noise, and a t test would take any
// difference for certain.
//
// Pictures of another estimator that contain none of its rare events are too dark, and have less noise
// than the golden's batches. But an estimator that simply has little noise looks the same, apart from
// the missing light. How much light can be missing? Let each event add e to a functional. If right
// pictures lack the light x without their events, each has x / e of them on average, and B pictures have
// none with the chance (Poisson)
//
//   exp(-B x / e),
//
// which is largest for the largest possible event E. Three things follow.
//
// - Darkness. The light d is missing; the noise of both means, with the standard error s, explains a
//   part of it, d - x, with a chance of at most exp(-(d - x)^2 / 2 s^2) (Chernoff), and unseen events
//   explain the rest. The product is largest for x = d - s^2 B / E: no p-value may be below
//       exp(-B d / E + (B s / E)^2 / 2).
//   If that x is negative, noise alone is the most likely explanation, and the t test has it.
// - Sensitivity. Of two errors that cancel, light that is missing in pictures without events, and an
//   estimator that is too bright, at most E ln(1 / level) / B can be hidden. So the error that is
//   detectable is larger by this. It falls as 1 / B: enough pictures exclude any event of this size.
// - The largest event. The golden contains the events, so none is larger than the largest deviation of a
//   pixel in one of its K batches, which is at most the square root of the sum of all squared
//   deviations, sqrt(K (K - 1)) times the standard error of the pixel. Nor can it be larger than the
//   largest deviation of the functional itself. In a large region of pixels with noise of their own, the
//   first bound is far smaller than the second: its noise is that of many events, which cannot all be
//   lacking at once. In a few pixels, of which one has all the light, both are the same. Events of
//   another estimator may be larger and rarer, here up to four times.

#include "golden/finding.h"
#include "golden/golden.h"
#include "golden/statistics.h"
#include "images/film.h"

namespace golden {

/// Whether the golden's batches after the pilot lack rare events that the pilot has: the variances of
/// the pixels, summed as for the finding's functional, are less than a tenth of those with the pilot.
/// Then the variance of the functional is far too small as well, and no test of means is possible.
bool lacks_rare_events(const Golden& golden, const Finding& finding);

/// The largest value that a rare event of the candidate's may add to a functional of one picture, by its
/// values alone; 0 if its own noise shows the events: its `pictures` have at least a tenth of the
/// standard deviation of `reference`, the golden's batches, of which `largest` is the largest value.
double largest_unseen_event(const Moments& pictures, const Moments& reference, double largest);

/// The same, by the noise of the golden's pixels as well. In units of values_of, for the finding's
/// functional. `samples`: of a pixel of a picture; 0: as many as in a batch of the golden. With more, a
/// sample adds less to the picture's mean, and its noise is smaller than that of a batch in any case.
double largest_unseen_event(const Golden& golden, const Finding& finding, const Moments& pictures,
                            double samples, const Moments& reference, double largest);

/// The smallest p-value that events up to this size allow for the difference of two means, two-sided as
/// that of welch; 0 if they cannot explain it. `pictures`: their number.
double least_p_of_darkness(double largest_event, double pictures, const MeanEstimate& candidate,
                           const MeanEstimate& expected, double tolerance);

/// The light that `pictures` pictures may lack with a chance of `level`, 0 < level < 1, if no event adds
/// more than `largest_event`. In its units.
double hidden_light(double largest_event, double pictures, double level);

/// Pixels that differ from the golden but have no noise, neither in it nor between the pictures.
struct QuietPixels {
    double pixels = 0.0;
    double pictures = 0.0;
    double difference = 0.0; // of the finding's functional, due to them
};

/// `moments`: of that many pictures. `rounding`: relative difference or noise that counts as none; of
/// `brightness`, the mean of the picture, where the golden is black.
QuietPixels quiet_pixels(const Golden& golden, const Finding& finding,
                         const images::BatchMoments& moments, double pictures, double rounding,
                         double brightness);

/// The smallest p-value that quiet pixels allow for the test of two means: theirs, if their difference
/// is due to rare events that all pictures have equally often and the golden has not; or that of the
/// other pixels alone. 0 without quiet pixels.
double least_p(const QuietPixels& quiet, const MeanEstimate& candidate, const MeanEstimate& expected,
               double tolerance);

} // namespace golden
