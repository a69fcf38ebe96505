#pragma once

// All pairs of boxes that overlap.

#include "scenes/bounds.h"

#include <cstdint>
#include <functional>
#include <span>

namespace scenes {

/// Calls found(a, b), a < b, for every pair of boxes that have a point in common; for some pairs several
/// times. Boxes are parted at the median of their centres, along the axis on which these spread most,
/// until few are left; a box on both sides goes to both. Where no axis parts them, up to 4096 boxes are
/// compared one by one, and more are not looked at. Returns whether all were.
bool for_each_overlap(std::span<const Bounds> boxes,
                      const std::function<void(std::uint32_t, std::uint32_t)>& found);

} // namespace scenes
