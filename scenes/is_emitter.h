#pragma once

// The emitters of a scene. A black light is not an emitter, and neither is a surface without area.

#include "scenes/for_each_light.h"

namespace scenes {

bool is_emitter(const Scene& scene, const Triangle& triangle);
bool is_emitter(const Scene& scene, const Sphere& sphere);
/// Of a light of for_each_light.h.
template <class Light>
bool is_emitter(const Light& light)
{
    return emitted_by(light) != Rgb(0.0);
}
bool has_environment(const Scene& scene);

/// Whether some triangle or sphere is an emitter.
bool has_emissive_geometry(const Scene& scene);

/// Whether there is any emitter: geometry, a light or the environment.
bool has_emitter(const Scene& scene);

} // namespace scenes
