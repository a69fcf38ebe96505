#pragma once

// Cuts polygons in space into triangles.

#include "scenes/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace scenes::polygons {

/// Polygons one after the other. Each has one ring, its outline, or several: the others are holes in it.
/// Ring i has sizes[i] corners, the next ones of `corners`.
struct Polygons {
    std::vector<std::uint32_t> sizes;   // per ring
    std::vector<std::uint32_t> corners; // vertex indices, each below the vertex count
    std::vector<std::uint32_t> rings;   // per polygon; empty if each has one
};

using Corners = std::array<Vec3, 3>;

/// Faults of the polygons of a mesh that can still be rendered.
struct PolygonFaults {
    std::size_t too_small = 0;   // fewer than three corners: no surface, dropped
    std::size_t small_holes = 0; // fewer than three corners: no hole, dropped
    std::size_t zero_area =
        0; // triangles; kept, for they are legal, but they neither stop a ray nor emit
    std::size_t non_planar = 0; // corners off the mean plane by more than a file's digits explain
    std::size_t crossed =
        0; // outlines that cross themselves or their holes: cut as a fan, without holes
    std::size_t too_large = 0; // more than most_corners and not convex: missing, so this is an error
};

/// Appends the triangles of each polygon to `triangles`, and counts its faults in `faults`. `positions`
/// are finite.
///
/// A polygon is cut in its mean plane. The normal of this plane is the sum of the area vectors of any
/// cut [Newell's method: Sutherland, Sproull, Schumacker 1974]; seen from the side of the normal the
/// outline turns left. A planar polygon (to the digits of a file) is cut exactly; any other is cut as
/// its perpendicular projection on the plane. There no triangle turns right, and together they cover the
/// polygon once. The result is the triangles (c0, ci, ci+1) around the first corner, in this order, if
/// they have these properties, as in every convex polygon; see cut_polygon (scenes/polygons/cut.h).
/// Polygons that cross themselves always get these triangles, although they cover a different area.
void triangulate(const Polygons& polygons, const std::vector<Vec3>& positions,
                 std::vector<Corners>& triangles, PolygonFaults& faults);

} // namespace scenes::polygons
