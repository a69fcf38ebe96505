#pragma once

// Measures the time and the error of renders.

#include "images/image.h"

#include <ctime>

namespace figures {

/// CPU time of this process so far, in seconds.
inline double cpu_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Mean over pixels and channels of (image - reference)^2 / (reference^2 + 1e-4 m^2), m the mean of the
/// reference. The term with m avoids a division by zero at black pixels.
inline double relative_mean_square_error(const images::Image& image, const images::Image& reference)
{
    images::Rgb mean(0.0);
    for (const auto& pixel : reference.pixels)
        mean += pixel / static_cast<double>(reference.pixels.size());
    const double m = (mean.x + mean.y + mean.z) / 3.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const images::Rgb d = image.pixels[i] - reference.pixels[i];
        const images::Rgb r = reference.pixels[i];
        sum += (d.x * d.x / (r.x * r.x + 1e-4 * m * m) + d.y * d.y / (r.y * r.y + 1e-4 * m * m) +
                d.z * d.z / (r.z * r.z + 1e-4 * m * m)) /
               3.0;
    }
    return sum / static_cast<double>(image.pixels.size());
}

} // namespace figures
