#include "tests/cuda/transport/float_scene.h"

#include "scenes/bounds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace fast_transport_test {

namespace {

using scenes::Vec3;

double rounded(double x)
{
    return nearest_float(x);
}

Vec3 rounded(const Vec3& v)
{
    return nearest_float(v);
}

void round_materials(scenes::Scene& scene)
{
    for (scenes::Material& material : scene.materials) {
        if (auto* lambertian = std::get_if<scenes::Lambertian>(&material))
            lambertian->albedo = rounded(lambertian->albedo);
        if (auto* mirror = std::get_if<scenes::Mirror>(&material))
            mirror->reflectance = rounded(mirror->reflectance);
        if (auto* glass = std::get_if<scenes::Glass>(&material))
            *glass = {rounded(glass->reflectance), rounded(glass->transmittance), rounded(glass->ior)};
        if (auto* emission = std::get_if<scenes::Emission>(&material))
            emission->radiance = rounded(emission->radiance);
    }
}

/// Rounds the lights without extent, relative to `origin` and with lengths multiplied by `scale`.
void round_lights(scenes::Scene& scene, const Vec3& origin, double scale)
{
    const double square = scale * scale;
    for (auto& light : scene.point_lights)
        light = {rounded(scale * (light.position - origin)), rounded(square * light.intensity)};
    for (auto& light : scene.spot_lights)
        light = {rounded(scale * (light.position - origin)), rounded(light.direction),
                 rounded(square * light.intensity), 1 - rounded(1 - light.cos_cutoff),
                 rounded(light.exponent)};
    for (auto& light : scene.directional_lights)
        light = {rounded(light.direction), rounded(light.irradiance)};
    if (scene.environment) scene.environment = rounded(*scene.environment);
}

void round_camera(scenes::Camera& camera, const Vec3& origin, double scale)
{
    camera.eye = rounded(scale * (camera.eye - origin));
    camera.right = rounded(camera.right);
    camera.up = rounded(camera.up);
    camera.backward = rounded(camera.backward);
}

/// Rounds every position on a surface, and so every sphere's radius, to the nearest multiple of
/// `step`.
void round_surfaces(scenes::Scene& scene, double step)
{
    for (auto& triangle : scene.triangles)
        for (Vec3& v : triangle.vertices) v = step * glm::round(v / step);
    for (auto& sphere : scene.spheres) {
        sphere.center = step * glm::round(sphere.center / step);
        sphere.radius = std::max(step, step * std::round(sphere.radius / step));
    }
}

/// Moves the surfaces so that `origin` becomes 0, and scales them.
void place_surfaces(scenes::Scene& scene, const Vec3& origin, double scale)
{
    for (auto& triangle : scene.triangles)
        for (Vec3& v : triangle.vertices) v = scale * (v - origin);
    for (auto& sphere : scene.spheres) {
        sphere.center = scale * (sphere.center - origin);
        sphere.radius *= scale;
    }
}

/// The power of two that scales the diameter of the scene to between 1 and 2.
double scale_of(const scenes::Bounds& box)
{
    return std::exp2(-std::floor(std::log2(glm::length(box.max - box.min))));
}

} // namespace

double nearest_float(double x)
{
    return static_cast<double>(static_cast<float>(x));
}

scenes::Vec3 nearest_float(const scenes::Vec3& v)
{
    return {nearest_float(v.x), nearest_float(v.y), nearest_float(v.z)};
}

scenes::Scene float_scene(scenes::Scene scene)
{
    Vec3 origin(0.0);
    double scale = 1.0;
    if (const auto box = scenes::bounds(scene)) {
        origin = (box->min + box->max) / 2.0;
        place_surfaces(scene, origin, 1.0);
        // The box then begins and ends on the grid, so that its centre is at a multiple of half a
        // step. Every point in the box is less than 2^23 half steps from it, which a float holds
        // exactly.
        round_surfaces(scene, 0x1p-21 / scale_of(*box));
        const auto on_grid = scenes::bounds(scene);
        const Vec3 rest = (on_grid->min + on_grid->max) / 2.0;
        scale = scale_of(*on_grid);
        place_surfaces(scene, rest, scale);
        origin += rest;
    }
    round_materials(scene);
    round_lights(scene, origin, scale);
    if (scene.camera) round_camera(*scene.camera, origin, scale);
    return scene;
}

} // namespace fast_transport_test
