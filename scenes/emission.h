#pragma once

// Which surfaces of a scene shine.

#include "scenes/scene.h"

namespace scenes {

/// Whether the material emits any light at all: an emission that is not black.
bool is_emissive(const Material& material);

/// Whether a triangle of non-zero area or a sphere has an emissive material.
bool has_emissive_geometry(const Scene& scene);

/// Whether anything in the scene shines: geometry, a light or the environment, and not with black light.
bool has_emitter(const Scene& scene);

} // namespace scenes
