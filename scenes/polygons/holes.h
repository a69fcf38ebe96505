#pragma once

// Turns polygons with holes into polygons without holes.

#include "scenes/polygons/crossings.h"

#include <optional>
#include <span>
#include <vector>

namespace scenes::polygons {

/// Joins each hole to the outline by a bridge that is walked to the hole and back. The result is one
/// closed walk, with the corners of all rings and two more per hole, because each bridge repeats two
/// corners. `outline` is counter-clockwise and `holes` are clockwise, all of three corners or more.
/// std::nullopt if some hole cannot be reached, for example one outside the outline.
std::optional<Ring> join_holes(std::span<const Point> points, const Ring& outline,
                               const std::vector<Ring>& holes);

} // namespace scenes::polygons
