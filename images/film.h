#pragma once

// A film accumulates batches of a render: their mean and its standard error.

#include "images/batch_fold.h"
#include "images/image.h"

#include <cstdint>
#include <vector>

namespace images {

/// Per pixel the mean over batches and the sum of squared deviations from it.
struct BatchMoments {
    Image mean;
    Image squares; // sums over the batches of (batch - mean)^2

    /// Makes these moments, of `own` batches, those of all `own + others` batches.
    void join(const BatchMoments& other, std::uint64_t own, std::uint64_t others);
    friend bool operator==(const BatchMoments&, const BatchMoments&) = default;
};

/// The moments of a range of batches, folded in blocks (batch_fold.h), so that the bits depend only on
/// the batches and their numbers, and not on where a render was interrupted or on which machines its
/// parts were made. A batch is the mean of a fixed number of samples per pixel: the unit of work, of
/// variance, of resuming and of parts.
class Film {
public:
    Film() = default;
    /// No batch yet; the first has the number `first`.
    Film(int width, int height, std::uint64_t first = 0) : width_(width), height_(height), fold_(first)
    {}
    /// A film in the state of an earlier one: the moments of its largest blocks. Throws
    /// std::invalid_argument if their number or a size disagrees.
    Film(int width, int height, const BatchRange& range, std::vector<BatchMoments> blocks);

    /// Adds the batch that follows, given as its mean per pixel. Throws std::invalid_argument if its
    /// size differs.
    void add_batch(const Image& batch);
    /// Adds the batches of another film, which follow. Throws std::invalid_argument if they do not, or
    /// if the size differs.
    void append(Film next);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] const BatchRange& range() const { return fold_.range(); }
    [[nodiscard]] std::uint64_t batches() const { return range().size(); }
    /// Of the largest blocks of the range, ascending.
    [[nodiscard]] const std::vector<BatchMoments>& blocks() const { return fold_.blocks(); }
    /// Of all batches, 0 if there is none. Computed from the blocks in each call.
    [[nodiscard]] BatchMoments moments() const;
    [[nodiscard]] Image mean() const { return moments().mean; }
    /// Standard error of the mean per pixel; infinite for fewer than two batches.
    [[nodiscard]] Image standard_error() const;
    friend bool operator==(const Film&, const Film&) = default;

private:
    int width_ = 0;
    int height_ = 0;
    BatchFold<BatchMoments> fold_;
};

/// Standard error of the mean of `batches` batches per pixel: sqrt(squares / (B (B - 1))); infinite for
/// B < 2.
Image standard_error(const BatchMoments& moments, std::uint64_t batches);

} // namespace images
