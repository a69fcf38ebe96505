#include "images/strategies.h"

#include <algorithm>
#include <cstddef>

namespace images {

void StrategySums::add(const Strategies& batch, std::uint32_t samples)
{
    for (const auto& [strategy, image] : batch) {
        Image& sum = sums_.try_emplace(strategy, image.width, image.height).first->second;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) sum.pixels[i] += image.pixels[i];
    }
    samples_ += samples;
}

Strategies StrategySums::means() const
{
    Strategies result;
    for (const auto& [strategy, sum] : sums_) {
        if (std::ranges::all_of(sum.pixels, [](const Rgb& pixel) { return pixel == Rgb(0.0); }))
            continue;
        Image& mean = result.emplace(strategy, sum).first->second;
        for (Rgb& pixel : mean.pixels) pixel /= static_cast<double>(samples_);
    }
    return result;
}

} // namespace images
