#include "cuda/transport/emitter_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace fast {

std::vector<float> summed_probabilities(const std::vector<double>& powers)
{
    constexpr std::int64_t grid = std::int64_t{1} << 24;
    const auto infinite =
        std::ranges::find_if(powers, [](double power) { return !std::isfinite(power); });
    if (infinite != powers.end())
        throw std::invalid_argument("the power of emitter " + std::to_string(infinite - powers.begin()) +
                                    " is not a finite number");
    const std::int64_t shining = std::ranges::count_if(powers, [](double power) { return power > 0; });
    if (shining == 0) return {};
    if (shining > grid)
        throw std::invalid_argument("more than 2^24 emitters: some could never be chosen");

    const double largest = std::ranges::max(powers); // the sum of powers could be infinite
    double total = 0;
    for (const double power : powers) total += power / largest;
    // Every emitter has one step of the grid; the others are shared out.
    const auto to_share = static_cast<double>(grid - shining);
    const double alike = 1.0 / static_cast<double>(shining);
    std::vector<float> sums;
    std::int64_t steps = 0;
    std::int64_t found = 0;
    double share = 0;
    for (const double power : powers) {
        if (power > 0) {
            share += (power / largest / total + alike) / 2; // map: emitter-choice
            steps = ++found + std::llround(to_share * share);
        }
        sums.push_back(static_cast<float>(std::ldexp(static_cast<double>(steps), -24)));
    }
    return sums;
}

} // namespace fast
