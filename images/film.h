#pragma once

// A film accumulates batches of a render: their mean and its standard error.

#include "images/image.h"

#include <cstdint>

namespace images {

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

} // namespace images
