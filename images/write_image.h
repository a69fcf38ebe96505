#pragma once

// One call for every kind of picture file: the ending of the name, in any case, says which.

#include "images/film.h"

#include <filesystem>

namespace images {

/// Writes the film as .exr (everything, see exr.h), .pfm (the mean alone) or .png (the mean, `exposure`
/// stops brighter, see png.h; the caller records the exposure where that matters). Throws ImageError.
void write_image(const std::filesystem::path& path, const Film& film, const Metadata& metadata,
                 double exposure = 0.0);

/// Throws the ImageError that write_image would throw for this name: unknown ending, no such folder, no
/// permission, not a file. To be called before hours of work. Leaves nothing behind, and leaves a file
/// that is there alone. What it cannot foresee is a disk that fills up.
void check_writable(const std::filesystem::path& path);

} // namespace images
