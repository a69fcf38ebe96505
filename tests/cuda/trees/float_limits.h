#pragma once

// Constants of single precision.

#include <limits>

namespace fast_trees_test {

inline constexpr float infinity = std::numeric_limits<float>::infinity();
inline constexpr double u = 0x1p-24; // the unit roundoff

} // namespace fast_trees_test
