#include "scenes/emission.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace scenes {
namespace {

bool is_black(const Rgb& color)
{
    return color == Rgb(0.0);
}

bool has_area(const Triangle& triangle)
{
    const auto& v = triangle.vertices;
    return glm::cross(v[1] - v[0], v[2] - v[0]) != Vec3(0.0);
}

} // namespace

bool is_emissive(const Material& material)
{
    const auto* emission = std::get_if<Emission>(&material);
    return emission != nullptr && !is_black(emission->radiance);
}

bool has_emissive_geometry(const Scene& scene)
{
    const auto shines = [&](const auto& primitive) {
        return is_emissive(scene.materials[primitive.material]);
    };
    return std::any_of(scene.spheres.begin(), scene.spheres.end(), shines) ||
           std::any_of(scene.triangles.begin(), scene.triangles.end(),
                       [&](const Triangle& triangle) { return shines(triangle) && has_area(triangle); });
}

bool has_emitter(const Scene& scene)
{
    const auto any = [](const auto& lights, auto strength) {
        return std::any_of(lights.begin(), lights.end(),
                           [&](const auto& light) { return !is_black(light.*strength); });
    };
    return has_emissive_geometry(scene) || any(scene.point_lights, &PointLight::intensity) ||
           any(scene.directional_lights, &DirectionalLight::irradiance) ||
           any(scene.spot_lights, &SpotLight::intensity) ||
           (scene.environment && !is_black(*scene.environment));
}

} // namespace scenes
