#pragma once

#include "scenes/scene.h"

namespace extremes {

/// A scene with one diffuse material, number 0, and nothing else.
inline scenes::Scene grey_scene()
{
    scenes::Scene scene;
    scene.name = "extremes";
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}};
    scene.material_names = {"grey"};
    return scene;
}

} // namespace extremes
