#include "trade/truth.h"

#include "trade/relative_error.h"

#include <algorithm>
#include <stdexcept>

namespace trade {

namespace {

constexpr std::size_t no_region = static_cast<std::size_t>(-1);

double sum_of_channels(const images::Rgb& color)
{
    return color.x + color.y + color.z;
}

/// The number of the functional that is the plain mean over this region.
std::size_t plain_functional(const golden::Functionals& functionals, std::size_t region)
{
    for (std::size_t f = 0; f < functionals.size(); ++f)
        if (functionals.at(f).region == region && functionals.at(f).weight == golden::Weight::plain)
            return f;
    throw std::logic_error("a region without a plain mean");
}

/// The brightness of each batch after the pilot: the channels together, relative to the pilot's.
/// `shares`: sums of the pilot's channels in the region.
std::vector<double> brightness_of_batches(const golden::Golden& golden, std::size_t functional,
                                          const images::Rgb& shares)
{
    std::vector<double> sums(golden.reference.size(), 0.0);
    for (std::size_t c = 0; c < golden::channel_count; ++c) {
        const double share = shares[static_cast<int>(c)] / sum_of_channels(shares);
        if (share == 0.0) continue;
        const std::vector<double> of_channel =
            golden::values_of(golden.reference, golden.functionals, functional, c);
        for (std::size_t b = 0; b < sums.size(); ++b) sums[b] += share * of_channel[b];
    }
    return sums;
}

} // namespace

Truth::Truth(const golden::Golden& golden)
    : mean_(golden.mean), standard_error_(golden.standard_error), weights_(relative_weights(mean_)),
      stratum_of_(mean_.pixels.size(), no_region),
      own_error_(weighted_square(weights_, standard_error_, images::Image(mean_.width, mean_.height)))
{
    if (golden.reference.size() < 2)
        throw std::invalid_argument("a truth needs two batches after its pilot at least");
    const golden::Functionals& functionals = golden.functionals;
    const images::Image& pilot = functionals.pilot().mean;
    for (std::size_t r = 0; r < functionals.regions().size(); ++r) {
        const golden::Region& region = functionals.regions()[r];
        const bool whole = region.kind == golden::RegionKind::whole;
        if (!whole && region.kind != golden::RegionKind::luminance) continue;
        const std::size_t functional = plain_functional(functionals, r);
        images::Rgb shares(0.0);
        for (std::size_t i = 0; i < pilot.pixels.size(); ++i) {
            if (functionals.pixel_weight(functional, 0, i) == 0.0) continue;
            shares += pilot.pixels[i];
            if (!whole) stratum_of_[i] = regions_.size();
        }
        const double sum = sum_of_channels(shares);
        if (!(sum > 0.0)) {
            if (whole) throw std::invalid_argument("the truth is black: there is no relative error");
            std::ranges::replace(stratum_of_, regions_.size(), no_region);
            continue;
        }
        const std::vector<double> batches = brightness_of_batches(golden, functional, shares);
        regions_.push_back(
            {golden::describe(region), golden::moments(batches), *std::ranges::max_element(batches)});
        pilot_sums_.push_back(sum);
    }
}

std::vector<double> Truth::brightness(const images::Image& picture) const
{
    if (picture.width != mean_.width || picture.height != mean_.height)
        throw std::invalid_argument("the picture and the truth differ in size");
    std::vector<double> sums(regions_.size(), 0.0);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const double value = sum_of_channels(picture.pixels[i]);
        sums[0] += value;
        if (stratum_of_[i] != no_region) sums[stratum_of_[i]] += value;
    }
    for (std::size_t r = 0; r < sums.size(); ++r) sums[r] /= pilot_sums_[r];
    return sums;
}

} // namespace trade
