#include "scenes/frame.h"

#include "scenes/bounds.h"
#include "scenes/read_scene.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace scenes {

void frame_camera(Scene& scene)
{
    if (!scene.camera) throw SceneError(scene.name + ": nothing to frame with: the scene has no camera");
    const std::optional<Bounds> box = bounds(scene);
    if (!box) throw SceneError(scene.name + ": nothing to frame: the scene has no geometry");
    const Vec3 center = 0.5 * box->min + 0.5 * box->max; // halves first: the sum may overflow
    const double diagonal = glm::length(box->max - box->min);
    if (!std::isfinite(diagonal)) throw SceneError(scene.name + ": too large to frame");
    scene.camera->eye = center + 1.5 * diagonal * scene.camera->backward;
}

} // namespace scenes
