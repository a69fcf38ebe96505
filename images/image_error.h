#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace images {

/// A picture file that cannot be read or written. what() is one line: "FILE: what is wrong".
class ImageError : public std::runtime_error {
public:
    ImageError(const std::filesystem::path& path, const std::string& problem);
};

} // namespace images
