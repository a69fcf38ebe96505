#pragma once

// Tests whether the outline of a polygon crosses itself.

#include "scenes/polygons/orientation.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scenes::polygons {

/// A closed walk from point to point, as indices into an array of points.
using Ring = std::vector<std::uint32_t>;

/// Whether the rings, taken together, cross themselves or one another: whether the walk passes from one
/// side of an edge, or of a corner, to the other. Rings that only touch do not cross. Exact, under the
/// condition of orientation(). Takes n log n steps for n points if few edges overlap along the axis on
/// which they are shorter in total.
bool cross(std::span<const Point> points, std::span<const Ring> rings);

} // namespace scenes::polygons
