#pragma once

// The ending of a file's name.

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>

namespace images {

/// Whether the name of `path` ends in `ending`, which is in lower case and begins with a dot: ".exr".
/// The name may be in any case: "A.EXR" has that ending too.
inline bool has_ending(const std::filesystem::path& path, std::string_view ending)
{
    std::string found = path.extension().string();
    std::ranges::transform(found, found.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return found == ending;
}

} // namespace images
