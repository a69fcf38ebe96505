#pragma once

// Files that are written completely or not at all.

#include <filesystem>
#include <string>
#include <string_view>

namespace images {

/// Makes `bytes` the content of the file `path`: writes them under a temporary name in the same folder,
/// waits until they are on the disk, and renames. After an error an earlier file is unchanged and no
/// temporary file remains. A symbolic link is followed. Throws ImageError.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Throws the ImageError that write_atomically would throw for a missing folder, a missing permission,
/// or a `path` that cannot be a file. Leaves no file behind.
void check_place(const std::filesystem::path& path);

/// The bytes of the regular file `path`. Throws ImageError.
std::string read_file(const std::filesystem::path& path);

} // namespace images
