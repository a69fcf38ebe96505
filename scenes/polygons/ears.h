#pragma once

// Triangles of a polygon, by cutting off its ears.

#include "scenes/polygons/crossings.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace scenes::polygons {

using PointTriangle = std::array<std::uint32_t, 3>;

/// Cuts a polygon along diagonals into walk.size() - 2 triangles, none of them clockwise. `walk` are its
/// corners, counter-clockwise, three or more. Returns std::nullopt on failure. It does not fail for
/// polygons that are simple, that only touch themselves, or that were joined to their holes by bridges.
///
/// The result is right, because the outline is the sum of the outlines of its triangles. So a point
/// around which the outline winds once lies in exactly one triangle, and a point outside lies in none,
/// provided that the outline winds at most once around any point and that no triangle is clockwise.
/// Corners that repeat the one before, and spikes, give triangles of zero area.
std::optional<std::vector<PointTriangle>> cut_ears(std::span<const Point> points, const Ring& walk);

} // namespace scenes::polygons
