#pragma once

// The noise of several pictures of a renderer that is not known, from how they differ in each pixel.
//
// B pictures give B values of a functional. Few values say little about their own variance and next to
// nothing about their skewness. But each picture has thousands of pixels. If the noise of different
// pixels is independent, the cumulants of a weighted sum are those of the pixels, weighted, and each
// pixel adds its own estimate: for the sum of w_i c_i,
//     variance = sum of w_i^2 variance_i,   third cumulant = sum of w_i^3 (third cumulant)_i.
// Pixels may depend on each other: one light path is splatted onto several. So this estimate is not
// taken as the truth, but as what is expected before the B values are seen: see `moderated`.

#include "golden/candidate.h"
#include "golden/statistics.h"

#include <cstddef>
#include <limits>

namespace golden {

/// The noise of one picture in a linear functional, if its pixels were independent.
struct PixelNoise {
    double variance = 0.0;
    double degrees = 0.0; // of freedom of this variance
    /// NaN for two pictures: their differences are symmetric whatever their distribution.
    double skewness = std::numeric_limits<double>::quiet_NaN();
};

/// Of a candidate of two pictures at least, in the functional's own units as by values_of. Unbiased
/// estimates of the variance and of the third cumulant of each pixel; degrees of the weighted sum of
/// variances by [Satterthwaite 1946, eq. 17]: many, unless a few pixels have nearly all of the noise.
PixelNoise pixel_noise(const Candidate& candidate, std::size_t functional, std::size_t channel);

/// The degrees of freedom that the variance of independent pixels is worth, at most, beside those of the
/// pictures' own values. 8 allow for a variance of 0.46 to 3.7 times that of independent pixels (95%):
/// the integrators here stay below 1.4 times (docs/comparison.md, section 5).
inline constexpr double pixel_degrees = 8.0;

/// The mean of the pictures' values with a variance that is shrunk towards that of independent pixels:
/// both weighted by their degrees of freedom, which add up [Smyth 2004, section 4].
MeanEstimate moderated(const Moments& pictures, const PixelNoise& pixels);

/// |skewness| of the mean of the pictures: that of their pixels, larger if the pictures' values scatter
/// more than independent pixels would; or what their own values show beyond the error of few values, if
/// that is more. For two pictures that of the golden's batches, scaled to the pictures' noise: an
/// estimator with k times the variance is taken for one with k times fewer samples.
double mean_skewness(const Moments& pictures, const PixelNoise& pixels, const Moments& reference);

} // namespace golden
