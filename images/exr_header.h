#pragma once

// The headers of an EXR file, checked before anything of the size that they state is allocated.

#include <ImfHeader.h>

#include <filesystem>
#include <string_view>
#include <vector>

namespace images {

/// One header for each part of the file. Every size that decides how much memory a reader needs is
/// checked against the length of the file: attributes, windows, tiles, tables of chunks. Throws
/// ImageError, and exceptions of OpenEXR, for a file that is no EXR, has only deep data, is damaged, or
/// is too short for what it states.
std::vector<Imf::Header> read_headers(const std::filesystem::path& path, std::string_view bytes);

/// Whether a part holds a flat picture: no deep data.
bool is_flat(const Imf::Header& header);

} // namespace images
