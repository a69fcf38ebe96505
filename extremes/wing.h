#pragma once

// Our implementations, as users run them.

#include "extremes/axis.h"

#include <string>
#include <vector>

namespace extremes {

/// The reference, the fast path on the processor, and the fast path on a GPU.
enum class Wing { ref, host, cuda };

/// "ref", "host" or "cuda".
std::string name_of(Wing wing);

/// In which numbers it computes.
Format format_of(Wing wing);

/// The wings that can be run here: ref, host, and cuda where there is a GPU.
std::vector<Wing> wings();

/// Whether a method is the fast path on a GPU: its name begins with "cuda".
bool on_device(const Method& method);

/// Adds to the limits of an axis those of its methods on a GPU: they compute what their twins on the
/// host compute, in the same format, so the same limits hold.
void add_limits_of_device(Axis& axis);

} // namespace extremes
