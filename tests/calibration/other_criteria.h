#pragma once

// What else pictures are compared by, to see what it would have found.

#include "images/image.h"

#include <string>
#include <vector>

namespace calibration {

/// A number by which a picture is found worse, the larger it is.
struct Criterion {
    std::string name;
    double (*badness)(const images::Image& picture, const images::Image& reference,
                      const images::Image& error_of_difference);
};

/// Root mean square error; 1 - SSIM [Wang et al. 2004], in windows of 8x8 pixels, of luminance with a
/// gamma of 2.2; the share of values whose z is beyond the limit that all of them together exceed with a
/// chance of 1% [Sidak 1967], as in tests that judge by z per pixel; the largest z of a pixel.
const std::vector<Criterion>& other_criteria();

} // namespace calibration
