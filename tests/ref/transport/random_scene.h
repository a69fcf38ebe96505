#pragma once

// Small random scenes: triangles and spheres, every material, every kind of emitter, a camera
// anywhere, often with glass around it or around a light.

#include "tests/ref/transport/generators.h"

#include "scenes/scene.h"

#include <rapidcheck.h>

#include <cmath>

namespace transport_test {

/// Uniform in (low, high).
inline double any_number(double low, double high)
{
    return low + (high - low) * *any_unit();
}

inline scenes::Vec3 any_point(double half_width)
{
    return {any_number(-half_width, half_width), any_number(-half_width, half_width),
            any_number(-half_width, half_width)};
}

/// Channels between `low` and 1.
inline scenes::Rgb any_colour(double low = 0.2)
{
    return {any_number(low, 1.0), any_number(low, 1.0), any_number(low, 1.0)};
}

inline bool any_chance(double probability)
{
    return *any_unit() < probability;
}

/// Materials of every scene below, by number; most surfaces are Lambertian.
enum : std::uint32_t { matte, grey, mirror, crown, water, lamp, glow };

/// A scene with any of the six kinds of emitters. Glass spheres may overlap other surfaces: the walks
/// handle each boundary in turn, and so must their densities.
inline scenes::Scene any_scene()
{
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{any_colour()},
                       scenes::Lambertian{any_colour()},
                       scenes::Mirror{any_colour()},
                       scenes::Glass{any_colour(), any_colour(), any_number(1.1, 2.0)},
                       scenes::Glass{scenes::Rgb(1.0), scenes::Rgb(1.0), 1.33},
                       scenes::Emission{3.0 * any_colour()},
                       scenes::Emission{any_colour()}};
    scene.material_names.assign(scene.materials.size(), "any");
    const auto any_surface = [] {
        constexpr std::uint32_t surfaces[] = {matte, matte, grey, mirror, crown, water};
        return surfaces[static_cast<std::size_t>(any_number(0.0, 6.0))];
    };
    const auto add_triangle = [&](std::uint32_t material) {
        const scenes::Vec3 p = any_point(1.0);
        scene.triangles.push_back({{p, p + any_point(1.5), p + any_point(1.5)}, material});
    };
    const auto add_sphere = [&](const scenes::Vec3& center, double radius, std::uint32_t material) {
        scene.spheres.push_back({center, radius, material});
    };

    const int surfaces = static_cast<int>(any_number(1.0, 5.0));
    for (int i = 0; i < surfaces; ++i) {
        if (any_chance(0.5))
            add_triangle(any_surface());
        else
            add_sphere(any_point(1.0), any_number(0.1, 0.7), any_surface());
    }
    // Half of the scenes are closed rooms, where walks are long; the others have a floor under sun and
    // sky.
    const bool closed = any_chance(0.5);
    if (closed) {
        add_sphere(scenes::Vec3(0.1, 0.0, -0.2), 3.0, any_chance(0.8) ? matte : crown);
    } else {
        scene.triangles.push_back({{scenes::Vec3(-2.5, -1.5, -0.8), scenes::Vec3(2.5, -1.5, -0.7),
                                    scenes::Vec3(0.0, 3.0, -0.9)},
                                   matte});
    }

    const auto in_glass = [&](const scenes::Vec3& p, double radius) {
        if (any_chance(0.5))
            add_sphere(p + any_point(0.2 * radius), radius, any_chance(0.5) ? crown : water);
    };
    if (any_chance(0.5)) add_triangle(lamp);
    if (any_chance(0.3)) add_triangle(glow);
    if (any_chance(0.5)) {
        const scenes::Vec3 center = any_point(1.0);
        add_sphere(center, any_number(0.02, 0.3), lamp);
        in_glass(center, 0.5);
    }
    if (any_chance(0.4)) {
        scene.point_lights.push_back({any_point(1.0), 3.0 * any_colour()});
        in_glass(scene.point_lights.back().position, 0.3);
    }
    if (any_chance(0.4)) {
        scene.spot_lights.push_back({any_point(1.0), *any_direction(), 20.0 * any_colour(),
                                     any_number(-1.0, 0.9),
                                     any_chance(0.3) ? 0.0 : any_number(0.0, 9.0)});
        in_glass(scene.spot_lights.back().position, 0.3);
    }
    if (!closed && any_chance(0.6))
        scene.directional_lights.push_back(
            {glm::normalize(any_point(0.7) - scenes::Vec3(0.0, 0.0, 1.0)), 4.0 * any_colour()});
    if (!closed && any_chance(0.6)) scene.environment = 2.0 * any_colour();

    const scenes::Vec3 eye = any_point(1.0);
    const scenes::Vec3 backward = // in open scenes mostly towards the middle
        closed || any_chance(0.3) ? *any_direction() : glm::normalize(eye + any_point(0.3));
    const scenes::Vec3 right = glm::normalize(glm::cross(scenes::Vec3(0.3, 0.8, -0.5), backward));
    scene.camera =
        scenes::Camera{eye,
                       right,
                       glm::cross(backward, right),
                       backward,
                       any_chance(0.5) ? scenes::FovAxis::horizontal : scenes::FovAxis::vertical,
                       any_number(0.3, 2.4)};
    in_glass(eye, 0.3);
    return scene;
}

} // namespace transport_test
