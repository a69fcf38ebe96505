#include "trade/rounds.h"

#include "golden/statistics.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>

namespace trade {

double student_quantile(double degrees, double confidence)
{
    if (std::isinf(degrees)) degrees = 1e12;
    return boost::math::quantile(
        boost::math::complement(boost::math::students_t(degrees), (1.0 - confidence) / 2.0));
}

Measured mean_of_rounds(const std::vector<double>& rounds, double confidence)
{
    if (rounds.size() < 2) throw std::invalid_argument("an interval needs at least two rounds");
    const golden::Moments moments = golden::moments(rounds);
    const double quantile = student_quantile(moments.count - 1.0, confidence);
    return {moments.mean, quantile * std::sqrt(moments.variance / moments.count)};
}

Estimate ratio_of_rounds(const std::vector<double>& a, const std::vector<double>& b, double confidence)
{
    if (a.size() != b.size()) throw std::invalid_argument("a ratio needs values of the same rounds");
    std::vector<double> logarithms;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!(a[i] > 0.0 && b[i] > 0.0)) throw std::invalid_argument("a ratio needs positive values");
        logarithms.push_back(std::log(a[i] / b[i]));
    }
    const auto [mean, half_width] = mean_of_rounds(logarithms, confidence);
    return {std::exp(mean), std::exp(mean - half_width), std::exp(mean + half_width)};
}

Estimate geometric_mean_of_rounds(const std::vector<double>& rounds)
{
    return ratio_of_rounds(rounds, std::vector<double>(rounds.size(), 1.0));
}

std::vector<std::vector<double>> measure_in_rounds(std::size_t rounds, std::mt19937_64& random,
                                                   const std::vector<Measurement>& measurements)
{
    std::vector<std::vector<double>> values(measurements.size(), std::vector<double>(rounds));
    std::vector<std::size_t> order(measurements.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t round = 0; round < rounds; ++round) {
        std::ranges::shuffle(order, random);
        for (const std::size_t i : order) values[i][round] = measurements[i](round);
    }
    return values;
}

std::string to_text(const Measured& measured)
{
    // So many decimals that the half width has two digits; none if it is above 10.
    const double exponent =
        measured.half_width > 0.0 ? std::floor(std::log10(measured.half_width)) : -2.0;
    const int decimals = std::clamp(1 - static_cast<int>(exponent), 0, 12);
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(), "%.*f +- %.*f", decimals, measured.mean, decimals,
                  measured.half_width);
    return text.data();
}

} // namespace trade
