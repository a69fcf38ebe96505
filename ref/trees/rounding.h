#pragma once

// How far a computed double can be from the real number it stands for [Higham 2002, sec. 3.1].

#include <limits>

namespace ref {

/// Unit roundoff u: every single operation returns its exact result times (1 + d), |d| <= u.
constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

/// Bound on |(1 + d_1) ... (1 + d_n) - 1|: what n roundings in a row do at worst.
constexpr double gamma_bound(int n)
{
    return n * unit_roundoff / (1 - n * unit_roundoff);
}

} // namespace ref
