#pragma once

// What shines in a scene. Black light does not, and neither does a surface without area.

#include "scenes/scene.h"

namespace scenes {

bool is_emitter(const Scene& scene, const Triangle& triangle);
bool is_emitter(const Scene& scene, const Sphere& sphere);
bool is_emitter(const PointLight& light);
bool is_emitter(const DirectionalLight& light);
bool is_emitter(const SpotLight& light);
bool has_environment(const Scene& scene);

/// Whether some triangle or sphere shines.
bool has_emissive_geometry(const Scene& scene);

/// Whether anything shines: geometry, a light or the environment.
bool has_emitter(const Scene& scene);

} // namespace scenes
