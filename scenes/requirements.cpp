#include "scenes/requirements.h"

namespace scenes {

Requirements requirements(const Scene& scene)
{
    Requirements needs;
    if (!scene.triangles.empty()) needs.shapes.insert(Shape::triangle);
    if (!scene.spheres.empty()) needs.shapes.insert(Shape::sphere);
    return needs;
}

} // namespace scenes
