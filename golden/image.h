#pragma once

// Pictures as data: a plain image, and a film that accumulates batches and knows its standard error.

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace golden {

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

/// What a picture says about its own making: scene, integrator, samples, seed and so on, by name.
using Metadata = std::map<std::string, std::string>;

/// Per pixel the mean over batches and the sum of squared deviations from it [Welford 1962], updated in
/// batch order, so that the bits depend only on the batches. A batch is the mean of a fixed number of
/// samples per pixel: the unit of work, of variance and of resuming.
class Film {
public:
    Film() = default;
    Film(int width, int height) : mean_(width, height), squares_(width, height) {}
    /// A film in the state of an earlier one. All sizes must agree.
    Film(Image mean, Image squares, std::uint64_t batches);

    /// Adds one batch, given as its mean per pixel. Throws std::invalid_argument if its size differs.
    void add_batch(const Image& batch);

    [[nodiscard]] std::uint64_t batches() const { return batches_; }
    [[nodiscard]] const Image& mean() const { return mean_; }
    /// Sums over the batches of (batch - mean)^2.
    [[nodiscard]] const Image& squares() const { return squares_; }
    /// Standard error of the mean per pixel: sqrt(squares / (B (B - 1))); infinite for B < 2.
    [[nodiscard]] Image standard_error() const;
    friend bool operator==(const Film&, const Film&) = default;

private:
    Image mean_;
    Image squares_;
    std::uint64_t batches_ = 0;
};

} // namespace golden
