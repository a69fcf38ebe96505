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

/// Cuts a polygon along diagonals into walk.size() - 2 triangles, none of them clockwise: `walk` are its
/// corners, counter-clockwise, three or more. None if that fails, which it does for no polygon that is
/// simple, touches itself only, or was joined to its holes by bridges.
///
/// What comes out is right: the outline is the sum of the outlines of its triangles. So a place around
/// which the outline winds once lies in exactly one triangle, and one outside lies in none, provided
/// that the outline winds no more than once around any place and that no triangle is clockwise.
/// Corners that repeat the one before, and spikes, give triangles of zero area.
std::optional<std::vector<PointTriangle>> cut_ears(std::span<const Point> points, const Ring& walk);

} // namespace scenes::polygons
