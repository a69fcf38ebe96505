#pragma once

// Polygons with holes, made into polygons without.

#include "scenes/polygons/crossings.h"

#include <optional>
#include <span>
#include <vector>

namespace scenes::polygons {

/// Joins each hole to the outline by a bridge that is walked to the hole and back: one closed walk, in
/// which each bridge repeats two corners, so of as many corners as all rings together and two more per
/// hole. `outline` is counter-clockwise and `holes` are clockwise, all of three corners or more. None if
/// some hole cannot be reached, as one outside of the outline.
std::optional<Ring> join_holes(std::span<const Point> points, const Ring& outline,
                               const std::vector<Ring>& holes);

} // namespace scenes::polygons
