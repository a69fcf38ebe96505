#pragma once

// Numbers in the precision in which a file holds them.

namespace golden {

/// `value` in single precision.
float to_float(double value);

/// `value` in half precision, clamped to the finite numbers of that: at most 65504 in size.
double rounded_to_half(double value);

} // namespace golden
