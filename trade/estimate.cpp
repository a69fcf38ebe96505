#include "trade/estimate.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace trade {

std::string to_text(const Estimate& estimate)
{
    if (!estimate.stated()) return "unknown";
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(), "%.3g (%.3g to %.3g)", estimate.value, estimate.low,
                  estimate.high);
    return text.data();
}

std::string error_to_text(const Estimate& estimate)
{
    if (!estimate.stated()) return "unknown";
    // So many decimals that the half width has two digits.
    const double half_width = 50.0 * (estimate.high - estimate.low);
    const int decimals = half_width > 0.0
                             ? std::clamp(1 - static_cast<int>(std::floor(std::log10(half_width))), 0, 6)
                             : 2;
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(), "%+.*f%% (%+.*f%% to %+.*f%%)", decimals,
                  100.0 * estimate.value, decimals, 100.0 * estimate.low, decimals,
                  100.0 * estimate.high);
    return text.data();
}

std::string percent_to_text(double relative)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g%%", 100.0 * relative);
    return text.data();
}

} // namespace trade
