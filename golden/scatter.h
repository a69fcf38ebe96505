#pragma once

// The noise of a single picture, as its pixels show it.

#include "golden/golden.h"
#include "golden/statistics.h"
#include "images/image.h"

#include <cstddef>

namespace golden {

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
                std::size_t channel);

/// A functional of a picture, and |skewness| / sqrt(n) of its noise.
struct PictureEstimate {
    MeanEstimate value;
    double skewed;
};

/// Its noise is assumed to be that of the golden's estimator for so many `batches`, of which `reference`
/// are the moments, and `extra`, a variance that it has besides; or what the pixels show, if that is
/// more.
PictureEstimate picture_estimate(const Scatter& shown, double value, const Moments& reference,
                                 double batches, double extra = 0.0);

} // namespace golden
