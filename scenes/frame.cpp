#include "scenes/frame.h"

#include "scenes/bounds.h"
#include "scenes/read_scene.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

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

void add_camera(Scene& scene)
{
    const Vec3 backward = glm::normalize(Vec3(1, -2, 1));
    const Vec3 right = glm::normalize(glm::cross(Vec3(0, 0, 1), backward));
    scene.camera =
        Camera{Vec3(0.0),         right, glm::cross(backward, right), backward, FovAxis::horizontal,
               glm::radians(45.0)};
    frame_camera(scene);
    scene.notices.emplace_back("no camera: seen from the front, right and above, along (-1, 2, -1) "
                               "with z up, the whole in view, at 45 degrees horizontally");
}

} // namespace scenes
