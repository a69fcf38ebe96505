#pragma once

// Reads all bytes of a file.

#include <filesystem>
#include <istream>
#include <string>
#include <string_view>

namespace scenes {

/// The bytes of the regular file at `path`, at most 2^30. Throws SceneError, with the file's name, if
/// the file is missing, not a regular file, larger, or not readable.
std::string file_bytes(const std::filesystem::path& path);

/// The rest of `stream`, at most 2^30 bytes. Throws SceneError, with `name`, if the stream holds more or
/// cannot be read.
std::string stream_bytes(std::istream& stream, const std::string& name);

/// A hash of `bytes` in 16 hexadecimal digits: Scene::hash.
std::string hash_of(std::string_view bytes);

} // namespace scenes
