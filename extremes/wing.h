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

/// Why no axis has a method of this name, if it is one of a GPU ("cuda", "cuda, path"); else empty.
std::string why_no_device(const std::string& method);

/// Adds to the limits of an axis those of its methods on a GPU: they compute what their twins on the
/// host compute, in the same format, so the same limits hold.
void add_limits_of_device(Axis& axis);

} // namespace extremes
