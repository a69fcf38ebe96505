#pragma once

// Parts of a render, each with some of its batches, in files of ours.

#include "images/exr.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace images {

struct Part {
    std::filesystem::path path;
    ExrSummary says;
    BatchRange range; // of its batches, at least one
};

/// What a part says of itself. Throws ImageError for a file without a state, such as a damaged one, and
/// for one without batches.
Part read_part(const std::filesystem::path& path);

/// Entries of the metadata that depend on the batches, not on the render.
Metadata without_counts(Metadata metadata);

/// Throws ImageError, with the first difference, unless `other` is a part of the same render as `first`:
/// size, scene, options, version of this program.
void expect_same_render(const Part& first, const Part& other);

/// The parts in the order of their batches, which are then consecutive. With `batches`, the number of
/// batches of the whole, they must be those from 0 on. Throws ImageError, with the names of the files
/// and the numbers of the batches, for parts of different renders, of different versions of this
/// program, and for missing, doubled or superfluous batches; std::invalid_argument if there is no part.
std::vector<Part> in_order(std::vector<Part> parts, std::optional<std::uint64_t> batches = std::nullopt);

} // namespace images
