#pragma once

// Bounds on the difference between a computed double and the exact real number [Higham 2002, sec.
// 3.1].

#include <limits>

namespace ref {

/// Unit roundoff u: every single operation returns its exact result times (1 + d), where |d| <= u.
constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

/// Upper bound on |(1 + d_1) ... (1 + d_n) - 1|: the relative error of n successive roundings.
constexpr double gamma_bound(int n)
{
    return n * unit_roundoff / (1 - n * unit_roundoff);
}

} // namespace ref
