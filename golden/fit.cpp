#include "golden/fit.h"

#include "golden/scatter.h"
#include "golden/weighted_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace golden {

namespace {

using images::Image;

/// Below it no further test of the explanation is made.
constexpr double clear_level = 1e-12;

Image without(const Image& picture, const Image& added)
{
    Image result = picture;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] -= added.pixels[i];
    return result;
}

/// The noise that the explanation adds to a functional. Pixels are taken as independent.
MeanEstimate noise_of(const Golden& golden, const Explanation& explanation, std::size_t functional,
                      std::size_t channel)
{
    const auto c = static_cast<int>(channel);
    double variance = 0.0;
    for_each_pixel(golden.functionals, functional, channel, [&](std::size_t i, double weight) {
        const double error = weight * explanation.error.pixels[i][c];
        variance += error * error;
    });
    return {0.0, variance, std::max(1.0, explanation.batches - 1.0)};
}

} // namespace

Fitting::Fitting(const Golden& golden, const std::vector<Image>& pictures, double samples,
                 const CompareOptions& options)
    : golden_(golden), pictures_(pictures), batches_(samples / batch_size_of(golden)),
      single_(pictures.size() == 1), judge_(golden, single_ ? Method::picture : Method::welch, options)
{
    Candidate candidate(golden.functionals);
    if (!single_)
        for (const Image& picture : pictures) candidate.add_batch(picture);
    for (std::size_t f = 0; f < golden.functionals.size(); ++f)
        for (std::size_t c = 0; c < channel_count; ++c) {
            references_.push_back(moments(values_of(golden.reference, golden.functionals, f, c)));
            const bool needed = !single_ && judge_.can_test(f);
            pixels_.push_back(needed ? pixel_noise(candidate, f, c) : PixelNoise{});
        }
}

Fit Fitting::fit(const Explanation& explanation) const
{
    const Functionals& functionals = golden_.functionals;
    std::vector<Image> undone;
    std::vector<Row> rows;
    for (const Image& picture : pictures_) {
        undone.push_back(without(picture, explanation.adds));
        rows.push_back(functionals.evaluate(undone.back()));
    }
    Fit result;
    std::array<double, channel_count> detectable{};
    detectable.fill(std::numeric_limits<double>::infinity());
    for (std::size_t f = 0; f < functionals.size(); ++f)
        for (std::size_t c = 0; c < channel_count; ++c) {
            if (!judge_.can_test(f)) continue;
            const Moments& reference = references_[f * channel_count + c];
            const Estimate estimate = estimated(undone.front(), rows, explanation, f, c);
            if (f == 0) result.scatter[c] = estimate.scatter;
            const auto p = judge_.adjusted_p(estimate.value, estimate.skewed, reference, f, c);
            if (!p) continue;
            result.p = std::min(result.p, *p);
            if (result.p < clear_level) return result;
            if (functionals.regions()[functionals.at(f).region].kind != RegionKind::whole) continue;
            const double found = judge_.compared(estimate.value, f, c).detectable;
            // Where the golden is black nothing can be wrong by a factor.
            detectable[c] = std::isnan(found) ? 0.0 : std::min(detectable[c], found);
        }
    result.detectable = *std::max_element(detectable.begin(), detectable.end());
    return result;
}

Fitting::Estimate Fitting::estimated(const Image& undone, const std::vector<Row>& rows,
                                     const Explanation& explanation, std::size_t functional,
                                     std::size_t channel) const
{
    const MeanEstimate noise = noise_of(golden_, explanation, functional, channel);
    const std::vector<double> values = values_of(rows, golden_.functionals, functional, channel);
    if (single_) return of_picture(undone, values.front(), noise.variance, functional, channel);
    // To undo a mistake does not change by how much the pictures differ from each other.
    const std::size_t at = functional * channel_count + channel;
    const Moments shown = moments(values);
    const MeanEstimate mean = moderated(shown, pixels_[at]);
    return {{mean.mean, mean.variance + noise.variance, welch_degrees(mean, noise)},
            mean_skewness(shown, pixels_[at], references_[at]),
            0.0};
}

/// As compare_picture assumes its noise; `extra`: variance that it has besides.
Fitting::Estimate Fitting::of_picture(const Image& undone, double value, double extra,
                                      std::size_t functional, std::size_t channel) const
{
    const Moments& reference = references_[functional * channel_count + channel];
    const Scatter shown = scatter(golden_, undone, functional, channel);
    const PictureEstimate estimate = picture_estimate(shown, value, reference, batches_, extra);
    return {estimate.value, estimate.skewed, shown.variance + shown.golden};
}

} // namespace golden
