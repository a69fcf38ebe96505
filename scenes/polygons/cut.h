#pragma once

// Cuts a polygon in the plane into triangles.

#include "scenes/polygons/ears.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace scenes::polygons {

/// A polygon with this many corners takes some seconds; the time grows with the square of their number.
constexpr std::size_t most_corners = std::size_t{1} << 15U;

/// The triangles of a polygon. The first ring is its outline, counter-clockwise; the others are holes in
/// it, in either direction. All triangles are counter-clockwise or of zero area, and together they cover
/// the polygon once. There are n + 2 h - 2 of them for n corners in all rings and h holes, and every
/// corner is used. The result is the fan around the first corner of the outline if all triangles of the
/// fan are counter-clockwise, as in every convex polygon. A hole of fewer than three different corners
/// is left out.
///
/// std::nullopt if the rings cross themselves or one another, if the outline is clockwise, or if a hole
/// cannot be reached. Exact, under the condition of orientation().
///
/// Throws std::length_error for more than most_corners corners, unless they all lie within half a turn
/// around the first one.
std::optional<std::vector<PointTriangle>> cut_polygon(std::span<const Point> points,
                                                      const std::vector<Ring>& rings);

} // namespace scenes::polygons
