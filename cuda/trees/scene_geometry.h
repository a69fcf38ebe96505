#pragma once

// The primitives of a scene in single precision.

#include "cuda/trees/sphere.h"
#include "cuda/trees/triangle.h"
#include "scenes/scene.h"

#include <vector>

namespace fast {

/// The transformation of a scene's coordinates before they are rounded: x becomes (x - origin) scale.
/// So a scene far from the origin of its file loses no digits, and a scene of any size stays in the
/// range of floats.
struct Placement {
    scenes::Vec3 origin{0.0};
    double scale = 1.0;
    [[nodiscard]] Vec3 operator()(const scenes::Vec3& x) const { return Vec3((x - origin) * scale); }
};

// Coordinates beyond the range of floats become infinite, and the tree build rejects them.

/// Whether the triangle has area in the scene itself, see has_area.
bool has_area_in_double(const scenes::Triangle& triangle);

/// Whether the triangle can be hit on the fast path: it has area in the scene and also as floats.
///
/// In the scene: its height over its longest edge is more than the rounding of its coordinates, 2^-48
/// of the largest coordinate. A point between two others that is computed in double is up to 6
/// roundings of 2^-53 off their line; the edges and their product add fewer than 20 in the worst case.
///
/// As floats: the rounded corners are not on one line. If they are, no ray can hit the triangle in a
/// well-defined place, and its normal has no direction.
bool has_area(const scenes::Triangle& triangle, const Placement& place = {});

/// The triangles, with every coordinate rounded to the nearest float: triangles that shared a vertex
/// still share it.
///
/// A triangle without area becomes a point, its first corner. If its three corners on a line were
/// rounded one by one, they would form a sliver with a width of about 2^-24 of the scene, which stops
/// rays. At a point every edge function is exactly 0, and no ray ever hits it (intersect.h). Where
/// such a triangle filled a T-junction of a mesh, rays can now pass where they would have hit the
/// sliver: a gap of the same width.
std::vector<Triangle> triangles_of(const scenes::Scene& scene, const Placement& place = {});

/// The spheres, rounded in the same way.
std::vector<Sphere> spheres_of(const scenes::Scene& scene, const Placement& place = {});

/// The box of every primitive, numbered as by scenes::primitive_count: the boxes of `triangles_of`,
/// then those of `spheres_of`, rounded outwards.
std::vector<Aabb> boxes_of(const scenes::Scene& scene, const Placement& place = {});

} // namespace fast
