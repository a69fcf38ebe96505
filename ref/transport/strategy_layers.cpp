#include "ref/transport/strategy_layers.h"

#include <algorithm>
#include <stdexcept>

namespace ref {

namespace {

/// Paths of k edges have k + 1 strategies, s = 0 ... k; before them stand those of 1 ... k - 1 edges.
std::size_t index_of(int s, int t)
{
    const int k = s + t - 1;
    return static_cast<std::size_t>((k - 1) * (k + 2) / 2 + s);
}

} // namespace

StrategyLayers::StrategyLayers(int width, int height, int max_edges, bool weighted)
    : width_(width), height_(height), max_edges_(max_edges), weighted_(weighted)
{
    if (max_edges < 1 || max_edges > most_edges_of_layers)
        throw std::invalid_argument("a picture for each strategy needs paths of at most " +
                                    std::to_string(most_edges_of_layers) + " edges");
    sums_.assign(index_of(max_edges, 1) + 1, images::Image(width, height));
}

void StrategyLayers::add(const Contribution& contribution)
{
    sums_[index_of(contribution.s, contribution.t)].pixels[contribution.pixel] +=
        weighted_ ? contribution.weight * contribution.value : contribution.value;
}

void StrategyLayers::add_batch(const StrategyLayers& batch, std::uint32_t samples)
{
    for (std::size_t i = 0; i < sums_.size(); ++i)
        for (std::size_t pixel = 0; pixel < sums_[i].pixels.size(); ++pixel)
            sums_[i].pixels[pixel] += batch.sums_[i].pixels[pixel];
    samples_ += samples;
}

std::map<std::pair<int, int>, images::Image> StrategyLayers::means() const
{
    std::map<std::pair<int, int>, images::Image> result;
    for (int k = 1; k <= max_edges_; ++k)
        for (int s = 0; s <= k; ++s) {
            images::Image image = sums_[index_of(s, k + 1 - s)];
            const bool dark = std::all_of(image.pixels.begin(), image.pixels.end(),
                                          [](const Rgb& pixel) { return pixel == Rgb(0.0); });
            if (dark) continue;
            for (Rgb& pixel : image.pixels) pixel /= static_cast<double>(samples_);
            result.emplace(std::pair(s, k + 1 - s), std::move(image));
        }
    return result;
}

} // namespace ref
