#pragma once

// The pilot of a golden: some of its batches, by which regions and weights are chosen.

#include "images/film.h"
#include "images/image.h"

#include <cstdint>

namespace golden {

/// Per pixel and channel, the mean of the pilot's batches and their noise sqrt(v) / m, the relative
/// standard deviation of one batch (0 where m is not positive). What a golden stores of its pilot.
struct Pilot {
    images::Image mean;
    images::Image noise;
    std::uint64_t batches = 0;
    friend bool operator==(const Pilot&, const Pilot&) = default;
};

/// The pilot that a film of at least two batches makes, noise rounded to half precision, mean to single:
/// as a file holds them, so that a golden that was read and one that was made are the same. Throws
/// std::invalid_argument for fewer batches.
Pilot make_pilot(const images::Film& film);

} // namespace golden
