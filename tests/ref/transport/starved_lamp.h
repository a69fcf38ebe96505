#pragma once

// A plane lit by a small lamp, beside emitters that have nearly all of the power. If those are chosen
// nearly always, the plane is dark, and the samples show no variance.

#include "scenes/scene.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace transport_test {

namespace starved {
enum : std::uint32_t { plane, lamp };
}

/// A square of the given half width at z = 0 around the origin, albedo 0.5, with a point light of
/// intensity 1 at a height of 1. The camera looks straight down from beside the light, with a narrow
/// view.
inline scenes::Scene lamp_over_plane(double half_width)
{
    using scenes::Rgb;
    using scenes::Vec3;
    const double w = half_width;
    scenes::Scene scene;
    scene.name = "starved lamp";
    scene.materials = {scenes::Lambertian{Rgb(0.5)}, scenes::Emission{Rgb(1.0)}};
    scene.material_names = {"plane", "lamp"};
    scene.triangles = {{{Vec3(-w, -w, 0), Vec3(w, -w, 0), Vec3(w, w, 0)}, starved::plane},
                       {{Vec3(-w, -w, 0), Vec3(w, w, 0), Vec3(-w, w, 0)}, starved::plane}};
    scene.point_lights = {{Vec3(0, 0, 1), Rgb(1.0)}};
    scene.camera = scenes::Camera{Vec3(0.3, 0.2, 1.5),
                                  Vec3(1, 0, 0),
                                  Vec3(0, 1, 0),
                                  Vec3(0, 0, 1),
                                  scenes::FovAxis::horizontal,
                                  0.5};
    return scene;
}

/// Adds a second lamp of `ratio` times the power, at a height of 1, that faces away from the plane.
/// Its light hits nothing.
inline scenes::Scene lamp_beside_a_brighter_one(double ratio)
{
    using scenes::Rgb;
    using scenes::Vec3;
    scenes::Scene scene = lamp_over_plane(2);
    scene.triangles.push_back({{Vec3(1, 1, 1), Vec3(2, 1, 1), Vec3(1, 2, 1)}, starved::lamp});
    // Its power is pi A L; that of the point light is 4 pi I.
    scene.materials[starved::lamp] = scenes::Emission{Rgb(ratio * 4.0 / 0.5)};
    return scene;
}

/// Adds a sky of 0.1: the power that it sends onto the scene grows with the square of the width.
inline scenes::Scene lamp_under_sky(double half_width)
{
    scenes::Scene scene = lamp_over_plane(half_width);
    scene.environment = scenes::Rgb(0.1);
    return scene;
}

/// The mean, over the picture, of the radiance of the plane (directly lit, W m^-2 sr^-1): albedo (L +
/// I cos / (pi r^2)), by the midpoint rule over 64 points of each pixel. The relative error is below
/// 1e-4.
inline double radiance_of_lit_plane(const scenes::Scene& scene, int width, int height)
{
    const scenes::Camera& camera = *scene.camera;
    const double pixel = 2.0 * std::tan(camera.fov / 2.0) / width;
    constexpr int steps = 8;
    double sum = 0.0;
    for (int j = 0; j < height * steps; ++j)
        for (int i = 0; i < width * steps; ++i) {
            const double x = camera.eye.x + camera.eye.z * pixel * ((i + 0.5) / steps - 0.5 * width);
            const double y = camera.eye.y + camera.eye.z * pixel * ((j + 0.5) / steps - 0.5 * height);
            const double r2 = x * x + y * y + 1.0; // squared distance from the lamp, at height 1
            sum += 1.0 / (std::numbers::pi * r2 * std::sqrt(r2));
        }
    const double sky = scene.environment ? scene.environment->x : 0.0;
    return 0.5 * (sky + sum / (width * height * steps * steps));
}

} // namespace transport_test
