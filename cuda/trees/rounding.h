#pragma once

// Bounds on the difference between a computed float and the exact real number.

#include <limits>

namespace fast {

/// A single operation returns its exact result times 1 + d, |d| <= unit_roundoff.
constexpr float unit_roundoff = std::numeric_limits<float>::epsilon() / 2;

} // namespace fast
