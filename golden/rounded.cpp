#include "golden/rounded.h"

#include <half.h>

#include <algorithm>

namespace golden {

// Never inlined: g++ 12.2 at -O2 removes a pair of conversions double-float-double in vector registers.
[[gnu::noinline]] float to_float(double value)
{
    return static_cast<float>(value);
}

double rounded_to_half(double value)
{
    constexpr double largest = HALF_MAX;
    return static_cast<double>(static_cast<float>(half(to_float(std::clamp(value, -largest, largest)))));
}

} // namespace golden
