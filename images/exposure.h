#pragma once

// The brightness at which a picture is shown.

#include "images/image.h"

#include <cmath>

namespace images {

/// Stops that bring the picture's mean to a middle grey of 0.18, in whole stops; 0 for a black one.
inline double middle_exposure(const Image& image)
{
    double sum = 0.0;
    for (const Rgb& pixel : image.pixels) sum += pixel.x + pixel.y + pixel.z;
    const double mean = sum / (3.0 * static_cast<double>(image.pixels.size()));
    return mean > 0.0 ? std::round(std::log2(0.18 / mean)) : 0.0;
}

} // namespace images
