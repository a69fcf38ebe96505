#pragma once

// All pairs of boxes that overlap.

#include "scenes/bounds.h"

#include <cstdint>
#include <functional>
#include <span>

namespace scenes {

/// Calls found(a, b), a < b, for every pair of boxes that have a point in common; for some pairs several
/// times. The boxes are divided at the median of their centres, along the axis of the largest spread of
/// the centres, until few are left; a box on both sides goes to both. Boxes that no axis divides are
/// compared one by one if there are at most 4096 of them, and otherwise skipped. Returns whether no box
/// was skipped.
bool for_each_overlap(std::span<const Bounds> boxes,
                      const std::function<void(std::uint32_t, std::uint32_t)>& found);

} // namespace scenes
