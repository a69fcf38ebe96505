#pragma once

namespace golden {

/// The largest picture that is read or written: what is beyond is a damaged header, not a picture.
constexpr long long max_side = 1ll << 16;
constexpr long long max_pixels = 1ll << 28;

constexpr bool plausible_size(long long width, long long height)
{
    return width > 0 && height > 0 && width <= max_side && height <= max_side &&
           width * height <= max_pixels;
}

} // namespace golden
