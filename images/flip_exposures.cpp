// HDR-FLIP: LDR-FLIP over exposures [Andersson et al. 2021].

#include "images/flip.h"
#include "images/flip_colours.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace images {

using flip_colours::xyz_of_rgb;

namespace {

/// The tone curve of cameras and displays: the ACES curve (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5) in
/// the form that the papers use [Narkowicz 2016], exposure factor 0.6 included.
constexpr double k0 = 0.6 * 0.6 * 2.51;
constexpr double k1 = 0.6 * 0.03;
constexpr double k3 = 0.6 * 0.6 * 2.43;
constexpr double k4 = 0.6 * 0.59;
constexpr double k5 = 0.14;

Image displayed(const Image& image, double stops)
{
    Image result = image;
    const double factor = std::exp2(stops);
    for (Rgb& pixel : result.pixels)
        for (int c = 0; c < 3; ++c) {
            const double x = std::max(pixel[c], 0.0) * factor;
            // The limit of the quotient, where the squares would overflow.
            pixel[c] =
                x > 1e6 ? 1.0 : std::clamp((k0 * x * x + k1 * x) / (k3 * x * x + k4 * x + k5), 0.0, 1.0);
        }
    return result;
}

} // namespace

Exposures flip_exposures(const Image& reference)
{
    std::vector<double> luminance;
    for (const Rgb& pixel : reference.pixels) luminance.push_back((xyz_of_rgb * glm::max(pixel, 0.0)).y);
    if (luminance.empty()) return {0.0, 0.0, 1};
    std::sort(luminance.begin(), luminance.end());
    const double median =
        luminance[luminance.size() / 2];               // the upper one of two, as the authors take it
    if (luminance.back() == 0.0) return {0.0, 0.0, 1}; // black at any exposure
    // Where the curve reaches 85% [Andersson et al. 2021, sec. 3.1].
    constexpr double t = 0.85;
    constexpr double a = k0 - t * k3;
    constexpr double b = k1 - t * k4;
    constexpr double c = -t * k5;
    const double x = (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
    const double start = std::log2(x / luminance.back());
    // A picture with more than half of its pixels black has no median exposure: 10 stops then.
    const double stop = median > 0.0 ? std::log2(x / median) : start + 10.0;
    return {start, stop, std::max(2, static_cast<int>(std::ceil(stop - start)))};
}

ErrorMap flip(const Image& reference, const Image& test, double pixels_per_degree)
{
    expect_comparable(reference, test);
    const auto [start, stop, count] = flip_exposures(reference);
    ErrorMap worst(reference.pixels.size(), 0.0);
    for (int i = 0; i < count; ++i) {
        const double stops = count > 1 ? start + (stop - start) * i / (count - 1) : start;
        const ErrorMap map =
            flip_of_displayed(displayed(reference, stops), displayed(test, stops), pixels_per_degree);
        for (std::size_t k = 0; k < map.size(); ++k) worst[k] = std::max(worst[k], map[k]);
    }
    return worst;
}

} // namespace images
