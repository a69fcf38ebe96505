#pragma once

// The relative mean square error (relMSE) of a picture [Rousselle et al. 2011].

#include "images/image.h"

namespace trade {

/// 1 / (truth^2 + 1e-4 m^2) per pixel and channel, m the mean of the truth: the weight of a squared
/// error. The second term keeps dark pixels from deciding alone, and avoids a division by zero.
images::Image relative_weights(const images::Image& truth);

/// The mean over pixels and channels of weight * (a - b)^2. All have the same size.
double weighted_square(const images::Image& weights, const images::Image& a, const images::Image& b);

} // namespace trade
