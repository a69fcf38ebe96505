#pragma once

#include "scenes/scene.h"

#include <string>

namespace scenes {

/// For people: "triangle 5 (material "wall")". Triangles and spheres are counted separately, from 1.
inline std::string primitive_name(const Scene& scene, std::uint32_t primitive)
{
    const bool is_triangle = primitive < scene.triangles.size();
    const std::size_t number = is_triangle ? primitive : primitive - scene.triangles.size();
    return std::string(is_triangle ? "triangle " : "sphere ") + std::to_string(number + 1) +
           " (material \"" + scene.material_names[material_of(scene, primitive)] + "\")";
}

} // namespace scenes
