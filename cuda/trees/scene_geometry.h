#pragma once

// A scene's primitives in single precision.

#include "cuda/trees/sphere.h"
#include "cuda/trees/triangle.h"
#include "scenes/scene.h"

#include <vector>

namespace gpu {

/// Where a scene's coordinates go before they are rounded: x to (x - origin) scale. So a scene far from
/// the origin of its file loses no digits, and one of any size no range.
struct Placement {
    scenes::Vec3 origin{0.0};
    double scale = 1.0;
    [[nodiscard]] Vec3 operator()(const scenes::Vec3& x) const { return Vec3((x - origin) * scale); }
};

// Coordinates beyond the range of floats become infinite, and a build will reject them.

/// The triangles with every coordinate rounded to the nearest float: those that shared a vertex share it
/// still.
std::vector<Triangle> triangles_of(const scenes::Scene& scene, const Placement& place = {});

/// The spheres, rounded likewise.
std::vector<Sphere> spheres_of(const scenes::Scene& scene, const Placement& place = {});

/// The box of every primitive, numbered as by scenes::primitive_count: those of `triangles_of`, and
/// those of `spheres_of`, rounded outwards.
std::vector<Box> boxes_of(const scenes::Scene& scene, const Placement& place = {});

} // namespace gpu
