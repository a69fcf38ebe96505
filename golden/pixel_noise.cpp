#include "golden/pixel_noise.h"

#include "golden/weighted_pixels.h"

#include <algorithm>
#include <cmath>

namespace golden {

PixelNoise pixel_noise(const Candidate& candidate, std::size_t functional, std::size_t channel)
{
    const images::Image& squares = candidate.moments().squares;
    const images::Image& cubes = candidate.cubes();
    const auto c = static_cast<int>(channel);
    const auto count = static_cast<double>(candidate.batches());
    double variance = 0.0;
    double fourth = 0.0; // sum of squared variances
    double third = 0.0;
    for_each_pixel(candidate.functionals(), functional, channel, [&](std::size_t i, double weight) {
        const double own = weight * weight * squares.pixels[i][c] / (count - 1.0);
        variance += own;
        fourth += own * own;
        // The unbiased third cumulant is B / ((B - 1) (B - 2)) times the sum of cubes [Fisher 1930].
        third += weight * weight * weight * cubes.pixels[i][c];
    });
    PixelNoise noise;
    noise.variance = variance;
    if (!(variance > 0.0)) return noise;
    noise.degrees = (count - 1.0) * variance * variance / fourth;
    if (count > 2.0)
        noise.skewness =
            third * count / ((count - 1.0) * (count - 2.0)) / (variance * std::sqrt(variance));
    return noise;
}

MeanEstimate moderated(const Moments& pictures, const PixelNoise& pixels)
{
    const double own = pictures.count - 1.0;
    // If one pixel has all the noise, its variance is that of the pictures' values once more.
    const double added = std::clamp(pixels.degrees - own, 0.0, pixel_degrees);
    const double degrees = own + added;
    const double variance = (own * pictures.variance + added * pixels.variance) / degrees;
    return {pictures.mean, variance / pictures.count, degrees};
}

double mean_skewness(const Moments& pictures, const PixelNoise& pixels, const Moments& reference)
{
    const double n = pictures.count;
    const double variance = moderated(pictures, pixels).variance * n;
    if (n < 3.0) {
        if (!(reference.variance > 0.0)) return 0.0;
        return std::abs(reference.skewness) * std::sqrt(variance / reference.variance / n);
    }
    // Samples that are splatted onto m pixels at once: the variance is m times that of independent
    // pixels, the third cumulant m^2 times, the skewness sqrt(m) times.
    const double together = pixels.variance > 0.0 ? std::max(1.0, variance / pixels.variance) : 1.0;
    const double by_pixels =
        pixels.variance > 0.0 ? std::abs(pixels.skewness) * std::sqrt(together) : 0.0;
    // The standard error of the skewness of n normal values [Fisher 1930].
    const double error = std::sqrt(6.0 * (n - 2.0) / ((n + 1.0) * (n + 3.0)));
    return std::max(by_pixels, std::abs(pictures.skewness) - 2.0 * error) / std::sqrt(n);
}

} // namespace golden
