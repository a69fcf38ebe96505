#pragma once

// Rare events: samples of a pixel that few batches or pictures contain. Where those that are compared
// contain none, or each contains equally many, they have no noise, and a t test would take any
// difference for certain.

#include "golden/finding.h"
#include "golden/golden.h"
#include "golden/statistics.h"
#include "images/film.h"

namespace golden {

/// Whether the golden's batches after the pilot lack rare events that the pilot has: the variances of
/// the pixels, summed as for the finding's functional, are less than a tenth of those with the pilot.
/// Then the variance of the functional is far too small as well, and no test of means is possible.
bool lacks_rare_events(const Golden& golden, const Finding& finding);

/// Pixels that differ from the golden but have no noise, neither in it nor between the pictures.
struct QuietPixels {
    double pixels = 0.0;
    double pictures = 0.0;
    double difference = 0.0; // of the finding's functional, due to them
};

/// `film`: of the pictures. `rounding`: relative difference or noise that counts as none; of
/// `brightness`, the mean of the picture, where the golden is black.
QuietPixels quiet_pixels(const Golden& golden, const Finding& finding, const images::Film& film,
                         double rounding, double brightness);

/// The smallest p-value that quiet pixels allow for the test of two means: theirs, if their difference
/// is due to rare events that all pictures have equally often and the golden has not; or that of the
/// other pixels alone. 0 without quiet pixels.
double least_p(const QuietPixels& quiet, const MeanEstimate& candidate, const MeanEstimate& expected,
               double tolerance);

} // namespace golden
