#pragma once

// Lists of powers of very different size; some of them are 0.

#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace transport_test {

/// 0 to 40 powers, from 1e-12 to 1e12, one in five of them 0.
inline std::vector<double> any_powers()
{
    const auto power = rc::gen::map(rc::gen::inRange(-150, 121),
                                    [](int n) { return n < -120 ? 0.0 : std::pow(10.0, n / 10.0); });
    const auto count = static_cast<std::size_t>(*rc::gen::inRange(0, 41));
    return *rc::gen::container<std::vector<double>>(count, power);
}

inline double total_of(const std::vector<double>& powers)
{
    double total = 0.0;
    for (const double power : powers) total += power;
    return total;
}

inline auto number_with_power(const std::vector<double>& powers)
{
    return std::ranges::count_if(powers, [](double power) { return power > 0.0; });
}

} // namespace transport_test
