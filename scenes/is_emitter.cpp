#include "scenes/is_emitter.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace scenes {
namespace {

bool is_emissive(const Material& material)
{
    const auto* emission = std::get_if<Emission>(&material);
    return emission != nullptr && emission->radiance != Rgb(0.0);
}

} // namespace

bool is_emitter(const Scene& scene, const Triangle& triangle)
{
    const auto& v = triangle.vertices;
    return is_emissive(scene.materials[triangle.material]) &&
           glm::cross(v[1] - v[0], v[2] - v[0]) != Vec3(0.0);
}

bool is_emitter(const Scene& scene, const Sphere& sphere)
{
    return is_emissive(scene.materials[sphere.material]);
}

bool has_environment(const Scene& scene)
{
    return scene.environment && *scene.environment != Rgb(0.0);
}

bool has_emissive_geometry(const Scene& scene)
{
    const auto shines = [&](const auto& primitive) { return is_emitter(scene, primitive); };
    return std::any_of(scene.triangles.begin(), scene.triangles.end(), shines) ||
           std::any_of(scene.spheres.begin(), scene.spheres.end(), shines);
}

bool has_emitter(const Scene& scene)
{
    bool any = has_emissive_geometry(scene) || has_environment(scene);
    for_each_light(scene, [&](const auto& light, std::size_t) { any = any || is_emitter(light); });
    return any;
}

} // namespace scenes
