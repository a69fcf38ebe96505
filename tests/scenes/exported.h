#pragma once

// A small scene with one of each kind, a random camera, and what the tests of all writers compare.

#include "ref/transport/camera.h"
#include "scenes/export/export.h"
#include "scenes/scene.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <array>
#include <cstdlib>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace scenes_test {

using scenes::Rgb;
using scenes::Scene;
using scenes::Vec3;
using Corners = std::array<Vec3, 3>;

/// Two triangles that face +z and -x, the second one an emitter, and a camera. The numbers are those
/// whose decimal text is long.
inline Scene exported_scene()
{
    Scene scene;
    scene.name = "small";
    scene.materials = {scenes::Lambertian{Rgb(0.1, 1.0 / 3.0, 0.7)},
                       scenes::Emission{Rgb(17.3, 5.1, 2.0 / 3.0)}};
    scene.material_names = {"a wall", "lamp & co"};
    scene.triangles.push_back(
        {{Vec3(0.1, 0.2, 0.3), Vec3(1.7, 0.4, 0.3), Vec3(1.0 / 3.0, 1.9, 0.3)}, 0});
    scene.triangles.push_back({{Vec3(2.1, 0.2, 0.1), Vec3(2.1, 0.4, 1.3), Vec3(2.1, 1.9, 0.6)}, 1});
    scene.camera = scenes::Camera{Vec3(0.5, -3.0, 0.7),
                                  Vec3(1, 0, 0),
                                  Vec3(0, 0, 1),
                                  Vec3(0, -1, 0),
                                  scenes::FovAxis::horizontal,
                                  1.0};
    return scene;
}

/// A camera anywhere, in any direction, sometimes with reversed x axis, as of a mirrored node.
inline scenes::Camera any_camera()
{
    const auto component = [] { return *rc::gen::inRange(-1000, 1001) / 500.0; };
    Vec3 up(component(), component(), component());
    Vec3 backward(component(), component(), component());
    RC_PRE(glm::length(glm::cross(up, backward)) > 0.1);
    backward = glm::normalize(backward);
    up = glm::normalize(up - glm::dot(up, backward) * backward);
    const double side = *rc::gen::arbitrary<bool>() ? 1.0 : -1.0;
    return {Vec3(component(), component(), component()),
            side * glm::cross(up, backward),
            up,
            backward,
            *rc::gen::arbitrary<bool>() ? scenes::FovAxis::horizontal : scenes::FovAxis::vertical,
            *rc::gen::inRange(1, 3000) / 1000.0};
}

inline scenes::exports::Options any_options()
{
    scenes::exports::Options options;
    options.width = *rc::gen::inRange(1, 400);
    options.height = *rc::gen::inRange(1, 400);
    return options;
}

/// Expects that direction_of(u, v), the direction through the point of the picture at the fractions u of
/// its width and v of its height, from the top left corner, is that of our camera's ray.
inline void expect_our_rays(const scenes::Camera& camera, const scenes::exports::Options& options,
                            const std::function<Vec3(double, double)>& direction_of, double tolerance)
{
    const ref::Camera ours(camera, options.width, options.height);
    for (const double u : {0.0, 0.25, 1.0})
        for (const double v : {0.0, 0.7, 1.0}) {
            const Vec3 expected = ours.ray({u * options.width, v * options.height}).direction;
            RC_ASSERT(glm::length(glm::normalize(direction_of(u, v)) - expected) < tolerance);
        }
}

/// All numbers in `text`; anything else separates them.
inline std::vector<double> numbers_in(std::string text)
{
    for (char& c : text)
        if (c == ',' || c == '[' || c == ']') c = ' ';
    std::istringstream stream(text);
    std::vector<double> numbers;
    for (std::string word; stream >> word;) numbers.push_back(std::strtod(word.c_str(), nullptr));
    return numbers;
}

inline Vec3 vector_in(const std::string& text)
{
    const std::vector<double> numbers = numbers_in(text);
    if (numbers.size() != 3) throw std::runtime_error("not three numbers: " + text);
    return {numbers[0], numbers[1], numbers[2]};
}

/// The corners of all triangles of `scene` with the material `material`.
inline std::vector<Corners> triangles_of(const Scene& scene, std::uint32_t material)
{
    std::vector<Corners> result;
    for (const auto& triangle : scene.triangles)
        if (triangle.material == material) result.push_back(triangle.vertices);
    return result;
}

} // namespace scenes_test
