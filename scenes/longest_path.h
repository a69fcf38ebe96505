#pragma once

// How long the paths of light in a scene can be.

#include "scenes/scene.h"

#include <optional>

namespace scenes {

/// An upper bound on the number of edges of a path that carries light from an emitter to the camera, the
/// camera's edge counted. None where none is proven, which is the ordinary case. The proofs:
///   0  There is no emitter, or no camera.
///   1  No surface scatters: all are black or emit. Light reaches the eye directly only.
///   2  All surfaces that scatter are triangles in one plane, across one of the axes. A path leaves the
///      plane at its first scattering and cannot meet the plane again.
/// The plane is found by comparing coordinates for equality, so no rounding is involved; other planes
/// are not recognised.
std::optional<int> longest_path(const Scene& scene);

} // namespace scenes
