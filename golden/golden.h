#pragma once

// A golden: a reference picture, with all data that a comparison with it needs. It is an EXR file (see
// images/exr.h) with further layers, all but the first in half precision:
//
//   pilot.mean.R ...        the mean of the pilot's batches, in single precision
//   pilot.noise.R ...       their relative standard deviation, sqrt(v) / m
//   reference.NNN.R ...     the standardised functionals (see functionals.h) of the batches after the
//                           pilot, channel by channel: first all of one batch, then all of the next,
//                           row by row through the layers 000, 001, ...; then, in the same way, their
//                           slopes (in a part without the first of these batches: none); the rest is 0
//   attributes plumbline.golden.pilot_batches, .reference_batches, .functionals
//
// R, G, B and se are the mean over all batches and its standard error, as in any picture of ours.

#include "golden/functionals.h"
#include "images/exr.h"
#include "images/film.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace golden {

struct Golden {
    images::Image mean;           // of all batches
    images::Image standard_error; // of that mean
    images::Metadata metadata;
    Functionals functionals;
    std::vector<Row> reference; // the functionals of each batch after the pilot
    Row slopes;                 // Functionals::slopes of the first of these batches

    /// Of pilot and reference together: those of `mean`.
    [[nodiscard]] std::uint64_t batches() const
    {
        return functionals.pilot().batches + reference.size();
    }
};

/// Samples per pixel in a batch, from the golden's metadata; 0 if there is no such entry.
double batch_size_of(const Golden& golden);

/// Reads a golden. Throws ImageError, with the reason, for a file that is no finished golden.
Golden read_golden(const std::filesystem::path& path);

/// Makes a golden, or a part of one, batch by batch. The bits depend only on the batches, not on
/// interruptions, nor on the parts.
class GoldenMaker {
public:
    /// The first `pilot_batches` batches, at least 2, are the pilot. The batch that is added first has
    /// the number `first`, which lies before the end of the pilot: throws std::invalid_argument.
    GoldenMaker(int width, int height, std::uint64_t pilot_batches, std::uint64_t first = 0);
    /// A part after the pilot, whose functionals are those of the complete pilot. Throws
    /// std::invalid_argument if `first` lies before its end.
    GoldenMaker(const Functionals& functionals, std::uint64_t first);

    /// Goes on from a file written with FilmState::keep. Throws ImageError if it is no such file.
    static GoldenMaker resume(const std::filesystem::path& path);

    /// Adds the batch that follows. Throws std::invalid_argument if the size differs or a pixel is NaN
    /// or infinite, and for a part that lacks the pilot's beginning at the end of the pilot.
    void add_batch(const images::Image& batch);
    /// Adds the batches of another part, which follow. Throws std::invalid_argument if they do not, if
    /// the parts are made with different pilots, or as add_batch.
    void append(GoldenMaker next);

    [[nodiscard]] const images::Film& film() const { return film_; } // of all batches
    [[nodiscard]] std::uint64_t pilot_batches() const { return pilot_batches_; }
    [[nodiscard]] std::uint64_t reference_batches() const { return reference_.size(); }
    /// Those of the pilot, once it is complete.
    [[nodiscard]] const std::optional<Functionals>& functionals() const { return functionals_; }

    /// The golden so far, as read_golden would return it. Throws std::invalid_argument before the first
    /// batch after the pilot, and for a part that lacks batch 0.
    [[nodiscard]] Golden golden(const images::Metadata& metadata) const;

    /// Writes the golden so far, with the state to resume from or, when it is finished, without.
    /// `metadata` describes the picture, batch_size included. Throws ImageError, and
    /// std::invalid_argument for a golden without state that has no batch after the pilot or lacks batch
    /// 0.
    void write(const std::filesystem::path& path, const images::Metadata& metadata,
               images::FilmState state) const;

private:
    void expect_room(std::uint64_t end) const;
    void complete_pilot();
    void expect_golden() const;
    void describe(images::Metadata& metadata) const;

    images::Film film_;
    std::uint64_t pilot_batches_;
    std::optional<Functionals> functionals_; // once the pilot is complete
    std::vector<Row> reference_;
    Row slopes_; // of the first batch after the pilot, if it is here: a mean over pixels needs no more
};

} // namespace golden
