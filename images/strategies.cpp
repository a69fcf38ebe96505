#include "images/strategies.h"

#include "images/whole_number.h"

#include <algorithm>
#include <cstddef>

namespace images {

std::optional<std::pair<int, int>> parse_layer_name(std::string_view text)
{
    const std::size_t t = text.find('t');
    if (!text.starts_with('s') || t == std::string_view::npos) return std::nullopt;
    const auto of_light = whole_number(text.substr(1, t - 1));
    const auto of_eye = whole_number(text.substr(t + 1));
    constexpr std::uint64_t most = 1u << 20; // far more vertices than a picture per strategy allows
    if (!of_light || !of_eye || *of_light > most || *of_eye > most) return std::nullopt;
    return std::pair(static_cast<int>(*of_light), static_cast<int>(*of_eye));
}

std::map<std::string, Image> layers_of(const Strategies& pictures)
{
    std::map<std::string, Image> layers;
    for (const auto& [strategy, image] : pictures)
        layers.emplace(layer_name(strategy.first, strategy.second), image);
    return layers;
}

void StrategyBlock::join(const StrategyBlock& other, std::uint64_t /*own*/, std::uint64_t /*others*/)
{
    for (const auto& [strategy, image] : other.sums) {
        Image& sum = sums.try_emplace(strategy, image.width, image.height).first->second;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) sum.pixels[i] += image.pixels[i];
    }
}

Strategies StrategySums::means(std::uint32_t batch_size) const
{
    const double samples = static_cast<double>(range().size()) * batch_size;
    const StrategyBlock total = fold_.total({});
    Strategies result;
    for (const auto& [strategy, sum] : total.sums) {
        if (std::ranges::all_of(sum.pixels, [](const Rgb& pixel) { return pixel == Rgb(0.0); }))
            continue;
        Image& mean = result.emplace(strategy, sum).first->second;
        for (Rgb& pixel : mean.pixels) pixel /= samples;
    }
    return result;
}

} // namespace images
