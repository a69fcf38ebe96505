#include "scenes/bounds.h"

#include <glm/common.hpp>

namespace scenes {

std::optional<Bounds> bounds(const Scene& scene)
{
    std::optional<Bounds> box;
    const auto include = [&box](const Vec3& low, const Vec3& high) {
        box = box ? Bounds{glm::min(box->min, low), glm::max(box->max, high)} : Bounds{low, high};
    };
    for (const Triangle& triangle : scene.triangles)
        for (const Vec3& vertex : triangle.vertices) include(vertex, vertex);
    for (const Sphere& sphere : scene.spheres)
        include(sphere.center - Vec3(sphere.radius), sphere.center + Vec3(sphere.radius));
    return box;
}

} // namespace scenes
