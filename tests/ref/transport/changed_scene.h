#pragma once

// The same scene moved or scaled, for tests of invariance.

#include "scenes/scene.h"

namespace transport_test {

/// Every length times `factor`. Intensities grow with its square, so that radiance is unchanged.
inline scenes::Scene scaled(scenes::Scene scene, double factor)
{
    for (auto& triangle : scene.triangles)
        for (scenes::Vec3& v : triangle.vertices) v *= factor;
    for (auto& sphere : scene.spheres) sphere.center *= factor, sphere.radius *= factor;
    for (auto& light : scene.point_lights) light.position *= factor, light.intensity *= factor * factor;
    for (auto& light : scene.spot_lights) light.position *= factor, light.intensity *= factor * factor;
    scene.camera->eye *= factor;
    return scene;
}

/// Everything moved by the vector `by`.
inline scenes::Scene moved(scenes::Scene scene, const scenes::Vec3& by)
{
    for (auto& triangle : scene.triangles)
        for (scenes::Vec3& v : triangle.vertices) v += by;
    for (auto& sphere : scene.spheres) sphere.center += by;
    for (auto& light : scene.point_lights) light.position += by;
    for (auto& light : scene.spot_lights) light.position += by;
    scene.camera->eye += by;
    return scene;
}

} // namespace transport_test
