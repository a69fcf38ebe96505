#pragma once

// A room in which no two surfaces touch: it has light of every length, and every connection is
// bounded.

#include "scenes/scene.h"

#include <glm/geometric.hpp>

namespace transport_test {

/// A matte ball and a light hang inside a matte sphere of radius 1; the light is a triangle that
/// shines downwards, or a point. No material is a mirror, so every strategy makes every path that its
/// ends allow. Between two points of the wall cos cos' / d^2 is always 1/4, and other pairs of
/// surfaces are at least 0.2 apart. So connections have a bounded variance, unlike in a room with
/// corners.
inline scenes::Scene rounded_room(bool lamp)
{
    using scenes::Rgb;
    using scenes::Vec3;
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{Rgb(0.7, 0.8, 0.5)}, scenes::Lambertian{Rgb(0.8, 0.6, 0.4)},
                       scenes::Emission{Rgb(5.0, 4.0, 3.0)}};
    scene.material_names = {"wall", "ball", "lamp"};
    scene.spheres = {{Vec3(0.0), 1.0, 0}, {Vec3(0.3, 0.35, -0.3), 0.25, 1}};
    if (lamp)
        scene.triangles = {{{Vec3(-0.5, 0.0, 0.5), Vec3(0.0, 0.5, 0.4), Vec3(0.2, -0.3, 0.5)}, 2}};
    else
        scene.point_lights = {{Vec3(-0.2, 0.1, 0.3), Rgb(3.0, 2.0, 1.0)}};
    const Vec3 backward = glm::normalize(Vec3(0.2, -0.9, 0.15));
    const Vec3 right = glm::normalize(glm::cross(Vec3(0.05, 0.0, 1.0), backward));
    scene.camera =
        scenes::Camera{Vec3(0.1, -0.6, 0.1),        right, glm::cross(backward, right), backward,
                       scenes::FovAxis::horizontal, 1.9};
    return scene;
}

} // namespace transport_test
