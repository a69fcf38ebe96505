#include "images/non_finite.h"

#include <algorithm>
#include <cmath>

namespace images {

std::optional<std::string> say_non_finite(const Image& image)
{
    const auto first = first_non_finite(image);
    if (!first) return std::nullopt;
    const auto count = std::count_if(image.pixels.begin(), image.pixels.end(), [](const Rgb& pixel) {
        return !std::isfinite(pixel.r) || !std::isfinite(pixel.g) || !std::isfinite(pixel.b);
    });
    const std::string place = "(" + std::to_string(first->x) + ", " + std::to_string(first->y) + ")";
    if (count == 1) return "pixel " + place + " is NaN or infinite";
    return std::to_string(count) + " pixels are NaN or infinite, the first is " + place;
}

} // namespace images
