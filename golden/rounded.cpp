#include "golden/rounded.h"

#include <half.h>

#include <algorithm>

namespace golden {

float to_float(double value)
{
    return static_cast<float>(value);
}

double rounded_to_half(double value)
{
    constexpr double largest = HALF_MAX;
    return static_cast<double>(static_cast<float>(half(to_float(std::clamp(value, -largest, largest)))));
}

} // namespace golden
