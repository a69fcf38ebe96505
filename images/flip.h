#pragma once

// FLIP: the visible difference of two pictures that are shown in turn.

#include "images/image.h"

#include <vector>

namespace images {

/// An error per pixel, row by row from the top left, between 0 (looks the same) and 1.
using ErrorMap = std::vector<double>;

/// Pixels per degree of visual angle: a display of 3840 pixels on 0.7 m, seen from 0.7 m away
/// [Andersson et al. 2020, sec. 4.1].
inline constexpr double default_pixels_per_degree = 67.02064;

/// Throws std::invalid_argument unless the pictures have one size and finite values.
void expect_comparable(const Image& reference, const Image& test);

/// LDR-FLIP [Andersson et al. 2020]: `reference` and `test` in linear RGB, values in [0, 1]. Throws
/// as expect_comparable.
ErrorMap flip_of_displayed(const Image& reference, const Image& test,
                           double pixels_per_degree = default_pixels_per_degree);

/// HDR-FLIP [Andersson et al. 2021]: the largest LDR-FLIP over the exposures at which a person would
/// look at `reference`, from its brightest pixel down to its median one. Values are radiances (negative
/// ones count as 0). Throws as above.
ErrorMap flip(const Image& reference, const Image& test,
              double pixels_per_degree = default_pixels_per_degree);

/// The exposures of `flip`, in stops.
struct Exposures {
    double start, stop;
    int count;
};
Exposures flip_exposures(const Image& reference);

} // namespace images
