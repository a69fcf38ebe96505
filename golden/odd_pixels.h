#pragma once

// Checks of single pixels, before all statistics: values that no right picture has, and values so far
// from the golden's that they dominate every mean that they are part of. docs/comparison.md, section 6,
// lists which of them make FAIL.

#include "golden/golden.h"
#include "images/image.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace golden {

enum class Oddity {
    negative, // radiance cannot be
    clipped,  // at least three values are exactly equal, where the golden is brighter
    dark,     // far below the golden: a dead pixel
    bright    // far above it: a firefly, or a defect
};

std::string describe(Oddity oddity); // "negative"

/// All pixels with one oddity. `channel`, `value` and the rest are those of the worst of them.
struct OddPixels {
    Oddity kind;
    std::vector<std::size_t> pixels; // y * width + x, ascending; not empty
    images::PixelPosition place;
    std::size_t channel;
    double value;
    double expected;   // the golden's mean there
    double deviations; // |value - expected| in standard deviations of the picture's pixels; dark, bright
    bool wrong;        // no right picture has it: FAIL
    std::optional<std::size_t> picture = {}; // of several, from 1; none: their mean
};

/// "1 pixel is negative, which radiance cannot be: red of pixel (3, 4) is -5"
std::string describe(const OddPixels& odd);

/// The odd pixels of a picture of the golden's size, without NaN, that is the mean of at least `batches`
/// batches (0 if not known). Empty for most pictures. A dark
/// pixel is wrong if the chance of any such pixel in a right picture is below `level`, see
/// chance_of_darkness. Pixels that are dark or bright are listed only if there are few: at most one
/// in 500, or one in a small picture.
std::vector<OddPixels> odd_pixels(const Golden& golden, const images::Image& picture, double batches,
                                  double level);

/// The numbers of all pixels that are listed, and of those that are listed as bright.
std::vector<std::size_t> pixels_of(const std::vector<OddPixels>& odd);
std::vector<std::size_t> bright_pixels(const std::vector<OddPixels>& odd);

/// `picture` with some pixels, by their numbers, taken from `other` of the same size.
images::Image replaced(images::Image picture, const std::vector<std::size_t>& pixels,
                       const images::Image& other);

/// Upper bound of the chance that the mean of `batches` independent values, none negative, of mean
/// `mean` and variance `variance`, is `value` < `mean` or less: exp(-n (m - x)^2 / (2 (v + m^2))),
/// whatever their distribution [Maurer 2003].
double chance_of_darkness(double value, double mean, double variance, double batches);

} // namespace golden
