#pragma once

// Are several pictures independent of each other? A renderer that ignores its seed gives the same noise
// every time; the mean of such pictures has more noise than their scatter shows. docs/comparison.md,
// section 5, derives the bounds.

#include "golden/golden.h"
#include "images/image.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace golden {

/// Two pictures, by their numbers from 0, that have the same noise, and the evidence for that.
struct SharedNoise {
    std::size_t first, second;
    std::string why; // "are equal in all 4096 pixels"
};

/// The first pair that is not independent; none if all may be. Two pictures are too alike if
///
/// - they are equal in all pixels, or by a thousandth of the golden's noise in all those that have noise
///   (each with every other: such pictures do not show what their noise is);
/// - there are three or more, and beside a third picture the two differ three times less, in nine tenths
///   of the pixels. Of three independent pictures that are equally good, whatever their noise, any two
///   are the closest in a pixel with a chance of 1/3;
/// - there are two, and they differ from each other ten thousand times less than from the golden.
///
/// Each picture is compared with the 256 before it. All must have the golden's size. Where the golden
/// has no noise, equal pictures are right: then there is no pair.
std::optional<SharedNoise> shared_noise(const Golden& golden, std::span<const images::Image> pictures);

/// The chance that independent pictures of `sites` independent pixels are taken for dependent, in one
/// comparison of three: the binomial tail from nine tenths of the sites on, each with a chance of 1/3.
double chance_of_shared_noise(std::size_t sites);

} // namespace golden
