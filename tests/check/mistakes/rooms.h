#pragma once

// Rooms without corners, in which all mistakes show with few samples.

#include "scenes/scene.h"

#include <glm/geometric.hpp>

namespace mistakes_test {

inline scenes::Camera camera_of_rooms()
{
    using scenes::Vec3;
    const Vec3 backward = glm::normalize(Vec3(0.2, -0.9, 0.55));
    const Vec3 right = glm::normalize(glm::cross(Vec3(0.05, 0.0, 1.0), backward));
    return {Vec3(0.1, -0.6, 0.1),        right, glm::cross(backward, right), backward,
            scenes::FovAxis::horizontal, 1.9};
}

/// A mirror ball and a large lamp in a matte sphere. Unweighted connections have a small variance, as no
/// two surfaces touch; and not every strategy can make every path.
inline scenes::Scene room_with_mirror()
{
    using scenes::Rgb;
    using scenes::Vec3;
    scenes::Scene scene;
    scene.name = "room with mirror";
    scene.materials = {scenes::Lambertian{Rgb(0.7, 0.8, 0.5)}, scenes::Mirror{Rgb(0.9, 0.8, 0.7)},
                       scenes::Emission{Rgb(5.0, 4.0, 3.0)}};
    scene.material_names = {"wall", "ball", "lamp"};
    scene.spheres = {{Vec3(0.0), 1.0, 0}, {Vec3(0.25, 0.3, -0.2), 0.5, 1}};
    scene.triangles = {{{Vec3(-0.6, -0.1, 0.5), Vec3(0.0, 0.6, 0.45), Vec3(0.4, -0.5, 0.5)}, 2}};
    scene.camera = camera_of_rooms();
    return scene;
}

/// A lamp and a matte ball in a glass ball, in a matte sphere with the camera: light is joined to eye
/// walks both in glass and in air.
inline scenes::Scene room_with_glass()
{
    using scenes::Rgb;
    using scenes::Vec3;
    scenes::Scene scene;
    scene.name = "room with glass";
    scene.materials = {scenes::Lambertian{Rgb(0.7, 0.8, 0.5)}, scenes::Lambertian{Rgb(0.8, 0.6, 0.4)},
                       scenes::Emission{Rgb(5.0, 4.0, 3.0)}, scenes::Glass{Rgb(1.0), Rgb(1.0), 1.5}};
    scene.material_names = {"wall", "ball", "lamp", "glass"};
    scene.spheres = {{Vec3(0.0), 1.0, 0},
                     {Vec3(0.3, 0.3, -0.1), 0.2, 1},
                     {Vec3(-0.1, 0.3, 0.1), 0.15, 2},
                     {Vec3(0.1, 0.3, 0.0), 0.5, 3}};
    scene.camera = camera_of_rooms();
    return scene;
}

} // namespace mistakes_test
