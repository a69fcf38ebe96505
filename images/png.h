#pragma once

// Pictures for people: 8 bits per channel, sRGB.

#include "images/image.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

namespace images {

using Srgb8 = std::array<std::uint8_t, 3>;

/// The colour of a pixel with a NaN channel.
constexpr Srgb8 nan_color = {255, 0, 255};

/// The colour `linear` * 2^exposure (stops) in sRGB [IEC 61966-2-1], rounded to the nearest of 0..255;
/// beyond [0, 1] each channel is clipped. A NaN in any channel gives nan_color.
Srgb8 to_srgb8(const Rgb& linear, double exposure);

/// The bytes of `image` as a PNG file through to_srgb8. Throws std::invalid_argument for sizes that PNG
/// cannot have.
std::string encode_png(const Image& image, double exposure = 0.0);

/// Writes `image` as PNG through to_srgb8. The exposure is not stored. Throws ImageError.
void write_png(const std::filesystem::path& path, const Image& image, double exposure = 0.0);

} // namespace images
