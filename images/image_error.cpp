#include "images/image_error.h"

#include <algorithm>

namespace images {

namespace {

/// Libraries' messages and file names may hold line breaks; a message for a person is one line.
std::string one_line(std::string text)
{
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
    return text;
}

} // namespace

ImageError::ImageError(const std::filesystem::path& path, const std::string& problem)
    : std::runtime_error(one_line(path.string() + ": " + problem))
{}

} // namespace images
