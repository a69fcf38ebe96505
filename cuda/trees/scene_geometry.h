#pragma once

// A scene's primitives in single precision.

#include "cuda/trees/sphere.h"
#include "cuda/trees/triangle.h"
#include "scenes/scene.h"

#include <vector>

namespace gpu {

// Coordinates are taken relative to `origin`, and then rounded: so a scene that is far from the origin
// of its file loses nothing if `origin` is near. Those beyond the range of floats become infinite, and a
// build will reject them.

/// The triangles with every coordinate rounded to the nearest float: those that shared a vertex share it
/// still.
std::vector<Triangle> triangles_of(const scenes::Scene& scene,
                                   const scenes::Vec3& origin = scenes::Vec3(0));

/// The spheres, rounded likewise.
std::vector<Sphere> spheres_of(const scenes::Scene& scene, const scenes::Vec3& origin = scenes::Vec3(0));

/// The box of every primitive, numbered as by scenes::primitive_count: those of `triangles_of`, and
/// those of `spheres_of`, rounded outwards.
std::vector<Box> boxes_of(const scenes::Scene& scene, const scenes::Vec3& origin = scenes::Vec3(0));

} // namespace gpu
