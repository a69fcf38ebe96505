#pragma once

// Other criteria for comparing pictures, to measure what they would have found.

#include "images/image.h"

#include <string>
#include <vector>

namespace calibration {

/// A number that is larger for a worse picture.
struct Criterion {
    std::string name;
    double (*badness)(const images::Image& picture, const images::Image& reference,
                      const images::Image& error_of_difference);
};

/// 1. Root mean square error.
/// 2. 1 - SSIM [Wang et al. 2004], in windows of 8x8 pixels, of luminance with a gamma of 2.2.
/// 3. The share of values whose z exceeds a limit, as in tests by z per pixel. The limit is the one that
///    the largest of all values exceeds with a probability of 1% [Sidak 1967].
/// 4. The largest z of a pixel.
const std::vector<Criterion>& other_criteria();

} // namespace calibration
