#pragma once

// The picture that others are compared with: its brightness over regions, with errors, and the weights
// by which errors of pixels are added up. It is a golden (golden/golden.h): regions are chosen by its
// pilot, and compared with its other batches, so that the choice does not favour either.

#include "golden/golden.h"
#include "golden/statistics.h"
#include "images/image.h"

#include <cstddef>
#include <string>
#include <vector>

namespace trade {

/// A part of the picture: the whole of it, or a stratum of pixels of similar luminance.
struct Region {
    std::string name;      // as golden::describe
    golden::Moments truth; // brightness of the truth's batches, relative to the pilot's: about 1
    double largest;        // of these values
};

class Truth {
public:
    /// Throws std::invalid_argument if the golden has fewer than two batches after the pilot or is
    /// black.
    explicit Truth(const golden::Golden& golden);

    /// The whole picture, then its strata from the darkest to the brightest, without black ones.
    [[nodiscard]] const std::vector<Region>& regions() const { return regions_; }

    /// The sum over pixels and channels of each region of `picture`, divided by that of the pilot.
    /// `picture` has the size of the truth: throws std::invalid_argument otherwise.
    [[nodiscard]] std::vector<double> brightness(const images::Image& picture) const;

    [[nodiscard]] const images::Image& mean() const { return mean_; }
    /// Of `mean`, per pixel.
    [[nodiscard]] const images::Image& standard_error() const { return standard_error_; }

    /// relative_weights of the mean.
    [[nodiscard]] const images::Image& weights() const { return weights_; }

    /// The relMSE of the truth itself, by its standard errors.
    [[nodiscard]] double own_error() const { return own_error_; }

private:
    images::Image mean_;
    images::Image standard_error_;
    images::Image weights_;
    std::vector<Region> regions_;
    std::vector<std::size_t> stratum_of_; // by pixel: index into regions_; 0 for a black stratum
    std::vector<double> pilot_sums_;      // by region
    double own_error_;
};

} // namespace trade
