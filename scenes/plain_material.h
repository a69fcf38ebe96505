#pragma once

// The material of all surfaces if materials are not read.

#include "scenes/scene.h"

namespace scenes {

/// Appends a grey Lambertian material, of albedo 0.5.
inline void add_plain_material(Scene& scene)
{
    scene.materials.emplace_back(Lambertian{Rgb(0.5)});
    scene.material_names.emplace_back("grey");
}

} // namespace scenes
