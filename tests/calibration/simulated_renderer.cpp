#include "tests/calibration/simulated_renderer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace calibration {

namespace {

constexpr std::size_t population_bits = 17;

double draw(Noise noise, std::mt19937_64& random)
{
    const double sigma = std::sqrt(std::numbers::ln2); // of the logarithm: relative deviation 1
    const auto lognormal = [&] {
        return std::lognormal_distribution<double>(-sigma * sigma / 2.0, sigma)(random);
    };
    const auto pareto = [&](double exponent) {
        const double u = 1.0 - std::uniform_real_distribution<double>()(random);
        return std::pow(u, -1.0 / exponent);
    };
    switch (noise) {
    case Noise::lognormal:
        return lognormal();
    case Noise::gamma:
        return std::gamma_distribution<double>(1.0)(random);
    case Noise::pareto_25:
        return pareto(2.5);
    case Noise::pareto_20:
        return pareto(2.0);
    case Noise::pareto_15:
        return pareto(1.5);
    case Noise::rare_bright:
        return std::uniform_real_distribution<double>()(random) < 1e-4 ? 100.0 : lognormal();
    }
    return 1.0;
}

std::vector<float> make_population(Noise noise, double chance_of_light, std::uint64_t seed)
{
    std::mt19937_64 random(seed);
    std::vector<double> batches(std::size_t{1} << population_bits);
    double sum = 0.0;
    for (double& batch : batches) {
        batch = 0.0;
        for (int sample = 0; sample < 4; ++sample)
            if (std::uniform_real_distribution<double>()(random) < chance_of_light)
                batch += draw(noise, random);
        sum += batch;
    }
    std::vector<float> population;
    for (const double batch : batches)
        population.push_back(static_cast<float>(batch * static_cast<double>(batches.size()) / sum));
    return population;
}

} // namespace

std::string name(Noise noise)
{
    switch (noise) {
    case Noise::lognormal:
        return "lognormal";
    case Noise::gamma:
        return "gamma";
    case Noise::pareto_25:
        return "Pareto 2.5";
    case Noise::pareto_20:
        return "Pareto 2.0";
    case Noise::pareto_15:
        return "Pareto 1.5";
    case Noise::rare_bright:
        return "rare bright samples";
    }
    return "";
}

SimulatedRenderer::SimulatedRenderer(int size, Noise noise, const Layout& layout,
                                     std::uint64_t population)
    : size_(size), population_{make_population(noise, 1.0, 3 * population + 1),
                               make_population(noise, layout.light_in_shadow, 3 * population + 2),
                               make_population(noise, layout.light_in_caustic, 3 * population + 3)}
{
    const auto pixels = static_cast<double>(size * size);
    const double caustic_radius = std::sqrt(layout.caustic_share * pixels / std::numbers::pi);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = (x + 0.5) / size;
            const double v = (y + 0.5) / size;
            Place place{lit, images::Rgb(0.7, 0.6, 0.5) * (0.3 + 0.5 * u + 0.2 * v)};
            if (u >= layout.shadow_left && u < layout.shadow_right && v >= layout.shadow_top &&
                v < layout.shadow_bottom)
                place = {shadow, 0.1 * place.mean};
            if (std::hypot(x - layout.caustic_x * size, y - layout.caustic_y * size) <= caustic_radius)
                place = {caustic, layout.caustic_brightness * place.mean};
            if (u + v < 0.1) place = {black, images::Rgb(0.0)};
            places_.push_back(place);
        }
}

images::Image SimulatedRenderer::render(std::uint64_t seed, std::uint64_t batch, const Bias& bias) const
{
    images::Image image(size_, size_);
    const std::array<double, 3> factor = {bias.everywhere, bias.everywhere * bias.in_shadow,
                                          bias.everywhere * bias.in_caustic};
    const std::uint64_t key = mix(mix(seed) ^ batch);
    constexpr std::uint64_t mask = (std::uint64_t{1} << population_bits) - 1;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const Place& place = places_[i];
        if (place.part == black) continue;
        const std::uint64_t word = mix(key + i);
        const std::vector<float>& population = population_[place.part];
        const double red_green = population[word & mask] * factor[place.part];
        const double blue = population[(word >> 32) & mask] * factor[place.part];
        image.pixels[i] = place.mean * images::Rgb(red_green, red_green, blue);
    }
    return image;
}

} // namespace calibration
