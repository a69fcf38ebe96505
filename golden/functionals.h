#pragma once

// A picture as a few hundred numbers per channel, its functionals: weighted means over regions. Batches
// are compared by these numbers and not pixel by pixel, because a small error everywhere is hidden by
// the noise of a single pixel and not by that of a mean.
//
// Regions and weights are computed from a pilot: some batches of the golden that are used for nothing
// else, so that the choice cannot depend on the noise of what is compared.

#include "golden/pilot.h"
#include "golden/region.h"
#include "images/image.h"

#include <array>
#include <cstdint>
#include <vector>

namespace golden {

/// A region and a weight.
struct Functional {
    std::size_t region; // into Functionals::regions()
    Weight weight;
};

/// The values of all functionals of one batch: value of functional f in channel c at [c * size() + f].
/// They are standardised, (value - expected) / spread, and rounded to half precision, which makes
/// small files and is the same rounding for everything that is compared.
using Row = std::vector<float>;

class Functionals {
public:
    /// Throws std::invalid_argument if the sizes differ, a value is not finite, or there is no pixel.
    explicit Functionals(Pilot pilot);

    [[nodiscard]] const Pilot& pilot() const { return pilot_; }
    [[nodiscard]] int width() const { return pilot_.mean.width; }
    [[nodiscard]] int height() const { return pilot_.mean.height; }
    [[nodiscard]] const std::vector<Region>& regions() const { return regions_; }
    /// Functionals per channel: each region with each weight, in that order.
    [[nodiscard]] std::size_t size() const { return regions_.size() * weights.size(); }
    [[nodiscard]] Functional at(std::size_t functional) const;

    /// The value of a right picture, before standardising. A linear functional is divided by its value
    /// of the pilot's mean: 1 is expected, and a relative error of the picture is the same relative
    /// error of the functional. Where the pilot is black it is the plain sum, and 0 is expected.
    [[nodiscard]] double expected(std::size_t functional, std::size_t channel) const;
    /// About the standard deviation of one batch, positive.
    [[nodiscard]] double spread(std::size_t functional, std::size_t channel) const;

    /// The functionals of a batch. Throws std::invalid_argument if its size differs or a pixel is NaN
    /// or infinite.
    [[nodiscard]] Row evaluate(const images::Image& batch) const;

    /// The derivative of each bounded functional with respect to a relative error of the whole picture,
    /// at this batch, standardised; 0 for the linear ones. Throws as evaluate.
    [[nodiscard]] Row slopes(const images::Image& batch) const;

    /// The pixel's share in a linear functional of its channel is weight * value; 0 outside the region.
    [[nodiscard]] double pixel_weight(std::size_t functional, std::size_t channel,
                                      std::size_t pixel) const;

private:
    struct Standard {
        double scale; // the functional is the weighted sum times this
        double expected;
        double spread;
    };
    using Sums = std::vector<std::array<double, 3>>; // per region, by weight

    void lay_out_regions();
    void weigh();
    void check(const images::Image& batch) const;
    /// c / (c + m), for a value c of the pixel.
    [[nodiscard]] double bounded(std::size_t pixel, int channel, double value) const;
    [[nodiscard]] bool contains(const Region& region, std::size_t pixel) const;
    /// Adds the sums over fine tiles up to those over coarse tiles and the whole picture.
    void sum_up(Sums& sums) const;
    template <class PixelTerms>
    [[nodiscard]] Sums sum_over_regions(const PixelTerms& terms) const;

    Pilot pilot_;
    std::vector<Region> regions_;
    int fine_side_ = 1;
    int fine_columns_ = 1, coarse_columns_ = 1;
    std::size_t first_coarse_ = 0, first_fine_ = 0, first_luminance_ = 0, first_noise_ = 0;
    struct Place {
        std::uint32_t fine, luminance, noise; // regions that the pixel lies in
    };
    std::vector<Place> places_;
    std::vector<images::Rgb> matched_; // m / v per pixel
    std::array<std::vector<Standard>, 3> standards_;
};

/// One functional of several batches, in its own units.
std::vector<double> values_of(const std::vector<Row>& rows, const Functionals& functionals,
                              std::size_t functional, std::size_t channel);

} // namespace golden
