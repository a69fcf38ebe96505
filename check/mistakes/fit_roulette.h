#pragma once

// Roulette that is not compensated, with the probability of survival that fits a picture best.

#include "check/mistakes/part_pictures.h"

#include <vector>

namespace check {

/// The mistake, and its probability of survival between 0.05 and 0.99, with which a right picture is
/// nearest to `picture`: by the sum of squared relative differences over blocks of an eighth of the
/// picture's longer side. `roulettes` must not be empty.
Mistake best_roulette(const std::vector<RouletteMistake>& roulettes, const PartPictures& parts,
                      const images::Image& picture, const images::Image& golden);

} // namespace check
