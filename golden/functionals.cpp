#include "golden/functionals.h"

#include "golden/rounded.h"
#include "images/non_finite.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace golden {

namespace {

constexpr std::size_t strata = 16;

double luminance(const images::Rgb& color)
{
    return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b; // Rec.709
}

/// The variance of a batch in one pixel, at least 3 m^2 / n. If an event occurs in none of n batches,
/// its chance is below 3 / n with 95% confidence (the rule of three); an event of the size of the mean m
/// with that chance has this variance.
double batch_variance(double mean, double noise, std::uint64_t batches)
{
    return mean * mean * std::max(noise * noise, 3.0 / static_cast<double>(batches));
}

/// For each pixel the stratum, of `strata` equally large ones by ascending `key`; equal keys in the
/// order of the pixels.
std::vector<std::uint32_t> stratify(const std::vector<double>& key)
{
    std::vector<std::size_t> order(key.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return key[a] < key[b]; });
    std::vector<std::uint32_t> stratum(key.size());
    const std::size_t count = std::min(strata, key.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank)
        stratum[order[rank]] = static_cast<std::uint32_t>(rank * count / order.size());
    return stratum;
}

} // namespace

Functionals::Functionals(Pilot pilot) : pilot_(std::move(pilot))
{
    const images::Image& mean = pilot_.mean;
    if (mean.pixels.empty() || mean.width != pilot_.noise.width || mean.height != pilot_.noise.height)
        throw std::invalid_argument("pilot: mean and noise are empty or differ in size");
    if (images::first_non_finite(mean) || images::first_non_finite(pilot_.noise))
        throw std::invalid_argument("pilot: a pixel is NaN or infinite");
    if (pilot_.batches < 1) throw std::invalid_argument("pilot: no batches");
    lay_out_regions();
    weigh();
}

void Functionals::lay_out_regions()
{
    const int w = width();
    const int h = height();
    const std::size_t pixels = pilot_.mean.pixels.size();
    regions_.push_back({RegionKind::whole, 0, 0, 0, w, h, pixels});
    fine_side_ = (std::max(w, h) + 7) / 8;
    const auto add_tiles = [&](RegionKind kind, int side) {
        int index = 0;
        for (int y = 0; y < h; y += side)
            for (int x = 0; x < w; x += side) {
                const int x1 = std::min(w, x + side);
                const int y1 = std::min(h, y + side);
                regions_.push_back(
                    {kind, index++, x, y, x1, y1, static_cast<std::size_t>((x1 - x) * (y1 - y))});
            }
        return (w + side - 1) / side;
    };
    first_coarse_ = regions_.size();
    coarse_columns_ = add_tiles(RegionKind::coarse_tile, 2 * fine_side_);
    first_fine_ = regions_.size();
    fine_columns_ = add_tiles(RegionKind::fine_tile, fine_side_);

    std::vector<double> by_luminance(pixels);
    std::vector<double> by_noise(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const images::Rgb& m = pilot_.mean.pixels[i];
        by_luminance[i] = luminance(m);
        const double sum = m.r + m.g + m.b;
        const images::Rgb deviation = pilot_.noise.pixels[i] * m;
        by_noise[i] = sum > 0.0 ? glm::dot(deviation, deviation) / (sum * sum) : 0.0;
    }
    const auto add_strata = [&](RegionKind kind, const std::vector<std::uint32_t>& stratum) {
        const std::size_t first = regions_.size();
        for (std::size_t i = 0; i < std::min(strata, pixels); ++i)
            regions_.push_back({kind, static_cast<int>(i), 0, 0, w, h, 0});
        for (const std::uint32_t s : stratum) ++regions_[first + s].pixels;
        return first;
    };
    const std::vector<std::uint32_t> luminance_of = stratify(by_luminance);
    const std::vector<std::uint32_t> noise_of = stratify(by_noise);
    first_luminance_ = add_strata(RegionKind::luminance, luminance_of);
    first_noise_ = add_strata(RegionKind::noise, noise_of);
    places_.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const int x = static_cast<int>(i % static_cast<std::size_t>(w));
        const int y = static_cast<int>(i / static_cast<std::size_t>(w));
        const auto tile = static_cast<std::size_t>(y / fine_side_ * fine_columns_ + x / fine_side_);
        places_[i] = {static_cast<std::uint32_t>(first_fine_ + tile),
                      static_cast<std::uint32_t>(first_luminance_ + luminance_of[i]),
                      static_cast<std::uint32_t>(first_noise_ + noise_of[i])};
    }
}

void Functionals::sum_up(Sums& sums) const
{
    const auto add = [](std::array<double, 3>& to, const std::array<double, 3>& from) {
        for (std::size_t w = 0; w < 3; ++w) to[w] += from[w];
    };
    for (std::size_t tile = 0; tile < first_luminance_ - first_fine_; ++tile) {
        const auto columns = static_cast<std::size_t>(fine_columns_);
        const std::size_t coarse =
            tile / columns / 2 * static_cast<std::size_t>(coarse_columns_) + tile % columns / 2;
        add(sums[first_coarse_ + coarse], sums[first_fine_ + tile]);
    }
    for (std::size_t tile = first_coarse_; tile < first_fine_; ++tile) add(sums[0], sums[tile]);
}

/// terms(pixel) are the pixel's contributions by weight.
template <class PixelTerms>
Functionals::Sums Functionals::sum_over_regions(const PixelTerms& terms) const
{
    Sums sums(regions_.size(), {0.0, 0.0, 0.0});
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const std::array<double, 3> term = terms(i);
        for (std::size_t w = 0; w < 3; ++w) {
            sums[places_[i].fine][w] += term[w];
            sums[places_[i].luminance][w] += term[w];
            sums[places_[i].noise][w] += term[w];
        }
    }
    sum_up(sums);
    return sums;
}

void Functionals::weigh()
{
    const std::vector<images::Rgb>& mean = pilot_.mean.pixels;
    matched_.assign(mean.size(), images::Rgb(0.0));
    std::vector<images::Rgb> variance(mean.size(), images::Rgb(0.0));
    for (std::size_t i = 0; i < mean.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            if (!(mean[i][c] > 0.0)) continue;
            variance[i][c] = batch_variance(mean[i][c], pilot_.noise.pixels[i][c], pilot_.batches);
            matched_[i][c] = mean[i][c] / variance[i][c];
            // A mean so small that its square is 0 gets the weight 0.
            if (!std::isfinite(matched_[i][c])) matched_[i][c] = 0.0;
        }
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        const auto c = static_cast<int>(channel);
        const Sums means = sum_over_regions([&](std::size_t i) -> std::array<double, 3> {
            return {matched_[i][c] * mean[i][c], mean[i][c], 0.5};
        });
        const Sums variances = sum_over_regions([&](std::size_t i) -> std::array<double, 3> {
            const double w = matched_[i][c];
            // To first order the standard deviation of c / (c + m) is a quarter of the relative one of
            // c. A value between 0 and 1 has a variance of at most 1/4.
            const double relative = mean[i][c] > 0.0 ? variance[i][c] / (mean[i][c] * mean[i][c]) : 0.0;
            return {w * w * variance[i][c], variance[i][c], std::min(0.25, relative / 16.0)};
        });
        standards_[channel].clear();
        for (std::size_t r = 0; r < regions_.size(); ++r)
            for (std::size_t w = 0; w < 3; ++w) {
                const double sum = means[r][w];
                const bool relative = is_linear(weights[w]) && sum > 0.0;
                Standard standard{1.0, 0.0, 1.0};
                if (relative) standard = {1.0 / sum, 1.0, std::sqrt(variances[r][w]) / sum};
                if (!is_linear(weights[w])) {
                    const auto n = static_cast<double>(regions_[r].pixels);
                    standard = {1.0 / n, sum / n, std::sqrt(variances[r][w]) / n};
                }
                if (!std::isfinite(standard.scale)) standard = {1.0, 0.0, 1.0};
                if (!(standard.spread > 0.0) || !std::isfinite(standard.spread)) standard.spread = 1.0;
                standards_[channel].push_back(standard);
            }
    }
}

Functional Functionals::at(std::size_t functional) const
{
    return {functional / weights.size(), weights[functional % weights.size()]};
}

double Functionals::expected(std::size_t functional, std::size_t channel) const
{
    return standards_[channel][functional].expected;
}

double Functionals::spread(std::size_t functional, std::size_t channel) const
{
    return standards_[channel][functional].spread;
}

void Functionals::check(const images::Image& batch) const
{
    if (batch.width != width() || batch.height != height() ||
        batch.pixels.size() != pilot_.mean.pixels.size())
        throw std::invalid_argument("has " + std::to_string(batch.width) + "x" +
                                    std::to_string(batch.height) + " pixels, the golden " +
                                    std::to_string(width()) + "x" + std::to_string(height()));
    if (const auto fault = images::say_non_finite(batch)) throw std::invalid_argument(*fault);
}

double Functionals::bounded(std::size_t pixel, int channel, double value) const
{
    const double light = std::max(0.0, value);
    const double m = std::max(0.0, pilot_.mean.pixels[pixel][channel]);
    // Where pilot and value are both black, 1/2 is expected.
    return light + m > 0.0 ? light / (light + m) : 0.5;
}

Row Functionals::evaluate(const images::Image& batch) const
{
    check(batch);
    Row row;
    row.reserve(channel_count * size());
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        const auto c = static_cast<int>(channel);
        const Sums sums = sum_over_regions([&](std::size_t i) -> std::array<double, 3> {
            const double value = batch.pixels[i][c];
            return {matched_[i][c] * value, value, bounded(i, c, value)};
        });
        for (std::size_t f = 0; f < size(); ++f) {
            const Standard& standard = standards_[channel][f];
            const double value = standard.scale * sums[f / weights.size()][f % weights.size()];
            row.push_back(
                static_cast<float>(rounded_to_half((value - standard.expected) / standard.spread)));
        }
    }
    return row;
}

Row Functionals::slopes(const images::Image& batch) const
{
    check(batch);
    Row row;
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        const auto c = static_cast<int>(channel);
        // The derivative of (1 + e) c / ((1 + e) c + m) by e at 0 is b (1 - b).
        const Sums sums = sum_over_regions([&](std::size_t i) -> std::array<double, 3> {
            const double value = batch.pixels[i][c];
            const double b = bounded(i, c, value);
            return {0.0, 0.0, value > 0.0 ? b * (1.0 - b) : 0.0};
        });
        for (std::size_t f = 0; f < size(); ++f) {
            const Standard& standard = standards_[channel][f];
            const double slope = standard.scale * sums[f / weights.size()][f % weights.size()];
            row.push_back(static_cast<float>(rounded_to_half(slope / standard.spread)));
        }
    }
    return row;
}

bool Functionals::contains(const Region& region, std::size_t pixel) const
{
    const auto r = static_cast<std::size_t>(&region - regions_.data());
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(width()));
    const int y = static_cast<int>(pixel / static_cast<std::size_t>(width()));
    switch (region.kind) {
    case RegionKind::luminance:
        return places_[pixel].luminance == r;
    case RegionKind::noise:
        return places_[pixel].noise == r;
    default:
        return x >= region.x0 && x < region.x1 && y >= region.y0 && y < region.y1;
    }
}

double Functionals::pixel_weight(std::size_t functional, std::size_t channel, std::size_t pixel) const
{
    const auto [region, weight] = at(functional);
    if (!is_linear(weight) || !contains(regions_[region], pixel)) return 0.0;
    const double scale = standards_[channel][functional].scale;
    return weight == Weight::matched ? scale * matched_[pixel][static_cast<int>(channel)] : scale;
}

std::vector<double> values_of(const std::vector<Row>& rows, const Functionals& functionals,
                              std::size_t functional, std::size_t channel)
{
    const double expected = functionals.expected(functional, channel);
    const double spread = functionals.spread(functional, channel);
    const std::size_t at = channel * functionals.size() + functional;
    std::vector<double> values;
    values.reserve(rows.size());
    for (const Row& row : rows) values.push_back(expected + spread * static_cast<double>(row[at]));
    return values;
}

} // namespace golden
