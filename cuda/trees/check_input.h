#pragma once

// Reports the boxes over which no tree can be built.

#include "cuda/trees/centroid_bounds.h"

#include <cstdint>
#include <span>

namespace fast {

/// Throws std::invalid_argument that names the primitive and the fault of its box, unless
/// `first_rejected` (Lbvh::first_rejected) is no_primitive. `boxes` are those of the build, on the
/// host.
void throw_if_rejected(std::uint32_t first_rejected, std::span<const Aabb> boxes);

} // namespace fast
