#pragma once

// Polygons to triangles, by fans around the first corner.

#include "scenes/collada/polygons.h"
#include "scenes/scene.h"

#include <array>
#include <cstddef>
#include <vector>

namespace scenes::collada {

using Corners = std::array<Vec3, 3>;

/// What is wrong with the polygons of a mesh, though it can still be rendered.
struct PolygonFaults {
    std::size_t too_small = 0; // fewer than three corners: no surface, dropped
    std::size_t zero_area =
        0; // triangles; kept, for they are legal, but they neither stop a ray nor emit
    std::size_t non_planar = 0; // corners off the mean plane by more than a file's digits explain
    std::size_t folded = 0;     // the fan leaves the polygon, which is not convex
};

/// Appends the triangles (c0, ci, ci+1) of each polygon to `triangles`; counts what is wrong in
/// `faults`.
void triangulate(const Polygons& polygons, const std::vector<Vec3>& positions,
                 std::vector<Corners>& triangles, PolygonFaults& faults);

} // namespace scenes::collada
