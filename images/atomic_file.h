#pragma once

// Files that are there whole or not at all.

#include <filesystem>
#include <string>
#include <string_view>

namespace images {

/// Makes `bytes` the content of the file `path`: writes them under a temporary name in the same folder,
/// waits until they are on the disk, and renames. Whatever goes wrong, a file that stood there before
/// stands there still, and no temporary remains. A symbolic link is followed. Throws ImageError.
void write_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Throws the ImageError that write_atomically would throw for want of a folder, of permission, or
/// because `path` is no place for a file; leaves nothing behind.
void check_place(const std::filesystem::path& path);

/// The bytes of the regular file `path`. Throws ImageError.
std::string read_file(const std::filesystem::path& path);

} // namespace images
