#pragma once

// The axis-aligned bounding box of a scene's geometry.

#include "scenes/scene.h"

#include <optional>

namespace scenes {

/// Corners of an axis-aligned box; min <= max in each coordinate.
struct Bounds {
    Vec3 min;
    Vec3 max;
};

/// The smallest box around all triangles and spheres; std::nullopt for a scene without them.
std::optional<Bounds> bounds(const Scene& scene);

} // namespace scenes
