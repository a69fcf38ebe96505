#include "golden/scatter.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace golden {

Scatter scatter(const Golden& golden, const images::Image& picture, std::size_t functional,
                std::size_t channel)
{
    const Functionals& functionals = golden.functionals;
    const Region& region = functionals.regions()[functionals.at(functional).region];
    const int side = std::clamp(std::max(picture.width, picture.height) / 32, 1, 4);
    const auto c = static_cast<int>(channel);
    std::vector<double> blocks;
    double golden_variance = 0.0;
    double noisy_blocks = 0.0;
    for (int y0 = region.y0; y0 < region.y1; y0 += side)
        for (int x0 = region.x0; x0 < region.x1; x0 += side) {
            double sum = 0.0;
            bool inside = false;
            const double golden_before = golden_variance;
            for (int y = y0; y < std::min(y0 + side, region.y1); ++y)
                for (int x = x0; x < std::min(x0 + side, region.x1); ++x) {
                    const auto i =
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                        static_cast<std::size_t>(x);
                    const double weight = functionals.pixel_weight(functional, channel, i);
                    if (weight == 0.0) continue;
                    inside = true;
                    sum += weight * (picture.pixels[i][c] - golden.mean.pixels[i][c]);
                    const double error = weight * golden.standard_error.pixels[i][c];
                    golden_variance += error * error;
                }
            if (inside) blocks.push_back(sum);
            noisy_blocks += golden_variance > golden_before;
        }
    const Moments found = moments(blocks);
    double fourth = 0.0;
    for (const double sum : blocks) fourth += std::pow(sum - found.mean, 4.0);
    // For normal deviations of variances v_i the sum of squares has variance 2 sum v_i^2, and the sum of
    // fourth powers has mean 3 sum v_i^2.
    return {found.variance * found.count - golden_variance,
            std::sqrt(2.0 / 3.0 * fourth),
            golden_variance,
            golden_variance * static_cast<double>(golden.batches()),
            found.count,
            noisy_blocks,
            found.skewness};
}

PictureEstimate picture_estimate(const Scatter& shown, double value, const Moments& reference,
                                 double batches, double extra)
{
    PictureEstimate estimate{{value, reference.variance / batches + extra, reference.count - 1.0},
                             std::abs(reference.skewness) / std::sqrt(batches)};
    if (!(shown.variance > estimate.value.variance)) return estimate;
    // Subtracting the golden's known part keeps the absolute error of the variance, so the relative
    // error grows by 1 / share. Below one degree quantiles overflow.
    const double share = shown.variance / (shown.variance + shown.golden);
    estimate.value.variance = shown.variance;
    estimate.value.degrees = std::max(1.0, (shown.blocks - 1.0) * share * share);
    estimate.skewed =
        std::max(estimate.skewed, std::abs(shown.blocks_skewness) / std::sqrt(shown.blocks));
    return estimate;
}

} // namespace golden
