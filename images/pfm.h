#pragma once

// Portable float maps: 32-bit floats after a header of three lines, the bottom row first.

#include "images/image.h"

#include <filesystem>

namespace images {

/// Writes colour (`PF`), little endian, each value rounded to float. Throws ImageError.
void write_pfm(const std::filesystem::path& path, const Image& image);

/// Reads colour (`PF`) or grey (`Pf`, into all three channels), of either byte order. The header must be
/// exactly two letters, width, height and scale, each with white space behind it, and the file must end
/// with the last pixel. The scale's sign is the byte order; its size multiplies each value, as in pbrt
/// and Mitsuba. Throws ImageError.
Image read_pfm(const std::filesystem::path& path);

} // namespace images
