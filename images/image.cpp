#include "images/image.h"

#include <cmath>

namespace images {

std::optional<PixelPosition> first_non_finite(const Image& image)
{
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Rgb& pixel = image.at(x, y);
            if (!std::isfinite(pixel.r) || !std::isfinite(pixel.g) || !std::isfinite(pixel.b))
                return PixelPosition{x, y};
        }
    return std::nullopt;
}

} // namespace images
