#pragma once

#include "images/image.h"
#include "images/image_error.h"

#include <filesystem>
#include <string>

namespace images {

/// Throws ImageError unless a picture of this size can be stored: at least 1x1, at most 2^16 pixels a
/// side and 2^28 together. A larger size is taken for a damaged header.
inline void check_size(const std::filesystem::path& path, long long width, long long height)
{
    constexpr long long max_side = 1ll << 16;
    constexpr long long max_pixels = 1ll << 28;
    if (width < 1 || height < 1 || width > max_side || height > max_side || width * height > max_pixels)
        throw ImageError(path, "absurd size " + std::to_string(width) + "x" + std::to_string(height));
}

inline void check_size(const std::filesystem::path& path, const Image& image)
{
    check_size(path, image.width, image.height);
}

} // namespace images
