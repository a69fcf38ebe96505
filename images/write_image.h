#pragma once

// Writes any kind of picture file. The ending of the name, in any case, chooses the format.

#include "images/film.h"

#include <filesystem>

namespace images {

/// Writes the film as .exr (everything, see exr.h), .pfm (the mean alone) or .png (the mean, `exposure`
/// stops brighter, see png.h; the exposure is not stored). Throws ImageError.
void write_image(const std::filesystem::path& path, const Film& film, const Metadata& metadata,
                 double exposure = 0.0);

/// Throws the ImageError that write_image would throw for this name: unknown ending, no such folder, no
/// permission, not a file. To be called before long work. It creates no file and does not change an
/// existing one. It cannot foresee a full disk.
void check_writable(const std::filesystem::path& path);

} // namespace images
