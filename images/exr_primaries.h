#pragma once

#include <ImfHeader.h>
#include <glm/mat3x3.hpp>

#include <filesystem>
#include <optional>

namespace images {

/// The matrix from the primaries and the white that an EXR file states to those of Rec.709, for column
/// vectors; none if it states none, or just these. The light stays the same: its CIE XYZ are converted,
/// and the eye's adaptation to another white is not imitated. Throws ImageError for values that are no
/// primaries.
std::optional<glm::dmat3> to_rec709(const std::filesystem::path& path, const Imf::Header& header);

} // namespace images
