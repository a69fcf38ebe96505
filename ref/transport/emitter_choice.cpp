#include "ref/transport/emitter_choice.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace ref {

std::vector<double> choice_borders(std::span<const double> powers)
{
    constexpr double cells = 0x1p24;
    double largest = 0.0;
    double count = 0.0; // of emitters that have power
    for (std::size_t i = 0; i < powers.size(); ++i) {
        if (!std::isfinite(powers[i]))
            throw std::invalid_argument("the power of emitter " + std::to_string(i) +
                                        " is not a finite number");
        largest = std::max(largest, powers[i]);
        if (powers[i] > 0.0) ++count;
    }
    if (count > cells)
        throw std::invalid_argument("more than 2^24 emitters: some could never be chosen");

    double total = 0.0; // in units of the largest: the sum of finite powers may not be finite
    for (const double power : powers)
        if (power > 0.0) total += power / largest;

    std::vector<double> borders;
    double rank = 0.0; // emitters with power so far
    double sum = 0.0;  // their shares
    double border = 0.0;
    for (const double power : powers) {
        if (power > 0.0) {
            ++rank;
            // map: emitter-choice [Hesterberg 1995]
            sum += 0.5 * (power / largest / total) + 0.5 / count;
            // One cell for each, and the rest by share. The sum ends at 1 within rounding, far less
            // than half a cell.
            border = (rank + std::round((cells - count) * sum)) / cells;
        }
        borders.push_back(border);
    }
    return borders;
}

} // namespace ref
