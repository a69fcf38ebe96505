#pragma once

// Pictures as data: a plain image in linear RGB.

#include <glm/vec3.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace images {

using Rgb = glm::dvec3;

/// Linear RGB, Rec.709 primaries, row by row from the top left. Pixel (x, y) is pixels[y * width + x].
struct Image {
    int width = 0;
    int height = 0;
    std::vector<Rgb> pixels;

    Image() = default;
    Image(int image_width, int image_height)
        : width(image_width), height(image_height),
          pixels(static_cast<std::size_t>(image_width) * static_cast<std::size_t>(image_height),
                 Rgb(0.0))
    {}
    /// The pixel in column x from the left and row y from the top.
    [[nodiscard]] Rgb& at(int x, int y) { return pixels[index(x, y)]; }
    [[nodiscard]] const Rgb& at(int x, int y) const { return pixels[index(x, y)]; }
    friend bool operator==(const Image&, const Image&) = default;

private:
    [[nodiscard]] std::size_t index(int x, int y) const
    {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

struct PixelPosition {
    int x, y; // from the top left
    friend bool operator==(const PixelPosition&, const PixelPosition&) = default;
};

/// The first pixel, row by row, with a channel that is NaN or infinite; none if all are finite.
std::optional<PixelPosition> first_non_finite(const Image& image);

/// The origin of a picture by name: scene, integrator, samples, seed and so on.
using Metadata = std::map<std::string, std::string>;

/// The metadata's entry `key`; the empty string if there is none.
inline std::string value_of(const Metadata& metadata, const std::string& key)
{
    const auto found = metadata.find(key);
    return found == metadata.end() ? "" : found->second;
}

} // namespace images
