#pragma once

// What very many equal terms add up to, bit for bit, without adding each of them: sums that nobody has
// the time for.

#include "cuda/transport/exact_sum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace extremes {

/// The sum of `n` terms `x` > 0, added one after the other in the format F and rounded to nearest.
///
/// While the sum s stays between two powers of two, it is a multiple of one unit in the last place, and
/// s + x is rounded to s + step with the same step: x rounded to a multiple of that unit. Only where x
/// is halfway between two multiples does it depend on s: the result is even, and so all later ones have
/// the same step again. So after two plain additions between the same powers of two the rest of the way
/// to the next one, but for its end, is one multiplication; it is exact. If step = 0, the sum does not
/// grow any more.
template <class F>
F sum_of_equal(F x, std::uint64_t n)
{
    F sum = 0;
    while (n > 1) {
        const F before = sum;
        const F middle = before + x;
        sum = middle + x;
        n -= 2;
        const F step = sum - middle; // exact: both differ by less than a factor of two
        if (step == 0) return sum;
        const int exponent = std::ilogb(sum);
        if (std::ilogb(before) != exponent) continue;
        const F steps = std::floor((std::ldexp(F{1}, exponent + 1) - sum) / step) - 2;
        if (steps <= 0) continue;
        const std::uint64_t leap = std::min(static_cast<std::uint64_t>(steps), n);
        sum += static_cast<F>(leap) * step;
        n -= leap;
    }
    return n > 0 ? sum + x : sum;
}

/// The same for the sum of --deterministic: its words count independently of each other, modulo 2^64.
inline fast::ExactSum exact_sum_of_equal(float x, std::uint64_t n)
{
    fast::ExactSum sum{};
    sum.add(x);
    for (std::uint64_t& word : sum.words) word *= n;
    sum.lost *= n;
    return sum;
}

} // namespace extremes
