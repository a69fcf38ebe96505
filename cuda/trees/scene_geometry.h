#pragma once

// A scene's primitives in single precision.

#include "cuda/trees/triangle.h"
#include "scenes/scene.h"

#include <vector>

namespace gpu {

/// The triangles with every coordinate rounded to the nearest float: those that shared a vertex share it
/// still. Coordinates beyond the range of floats become infinite, and a build will reject them.
std::vector<Triangle> triangles_of(const scenes::Scene& scene);

/// The box of every primitive, numbered as by scenes::primitive_count: of triangles those of
/// `triangles_of`, of spheres rounded outwards.
std::vector<Box> boxes_of(const scenes::Scene& scene);

} // namespace gpu
