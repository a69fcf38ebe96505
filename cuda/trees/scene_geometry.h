#pragma once

// A scene's primitives in single precision.

#include "cuda/trees/sphere.h"
#include "cuda/trees/triangle.h"
#include "scenes/scene.h"

#include <vector>

namespace fast {

/// Where a scene's coordinates go before they are rounded: x to (x - origin) scale. So a scene far from
/// the origin of its file loses no digits, and one of any size no range.
struct Placement {
    scenes::Vec3 origin{0.0};
    double scale = 1.0;
    [[nodiscard]] Vec3 operator()(const scenes::Vec3& x) const { return Vec3((x - origin) * scale); }
};

// Coordinates beyond the range of floats become infinite, and a build will reject them.

/// Whether the triangle has area in the scene itself, see has_area.
bool has_area_in_double(const scenes::Triangle& triangle);

/// Whether the triangle can be hit on the fast path: it has area in the scene, and as floats.
///
/// In the scene: its height over its longest edge is more than its coordinates' own rounding, 2^-48 of
/// the largest. A point between two others that is computed in double is as far off their line as 6
/// roundings of 2^-53, the edges and their product add fewer than 20 in worst cases.
///
/// As floats: the rounded corners are not on one line. No ray could hit it in a place that makes sense,
/// and its normal has no direction.
bool has_area(const scenes::Triangle& triangle, const Placement& place = {});

/// The triangles with every coordinate rounded to the nearest float: those that shared a vertex share it
/// still.
///
/// A triangle without area becomes a point, its first corner. Rounded one by one, three corners on a
/// line would be those of a sliver of about 2^-24 of the scene, and stop rays; at a point every edge
/// function is exactly 0, and no ray ever hits it (intersect.h). Where such a triangle filled a
/// T-junction of a mesh, rays may now pass where they met the sliver before: a gap of the same width.
std::vector<Triangle> triangles_of(const scenes::Scene& scene, const Placement& place = {});

/// The spheres, rounded likewise.
std::vector<Sphere> spheres_of(const scenes::Scene& scene, const Placement& place = {});

/// The box of every primitive, numbered as by scenes::primitive_count: those of `triangles_of`, and
/// those of `spheres_of`, rounded outwards.
std::vector<Aabb> boxes_of(const scenes::Scene& scene, const Placement& place = {});

} // namespace fast
