#pragma once

// A mesh of any size.

#include "scenes/scene.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace bench {

/// A sphere with bumps, of about `triangles` triangles in random order, so that no builder profits
/// from the order in the file.
inline scenes::Scene bumpy_sphere(const std::string& name, double triangles)
{
    constexpr double pi = 3.14159265358979323846;
    scenes::Scene scene;
    scene.name = name;
    scene.materials.emplace_back(scenes::Lambertian{scenes::Rgb(0.5)});
    const int n = static_cast<int>(std::sqrt(triangles / 2));
    const auto point = [&](int i, int j) {
        const double theta = pi * i / n;
        const double phi = 2 * pi * j / n;
        const double r = 1 + 0.1 * std::sin(9 * theta) * std::cos(7 * phi);
        return r * scenes::Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                std::cos(theta));
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            scene.triangles.push_back({{point(i, j), point(i + 1, j), point(i + 1, j + 1)}, 0});
            scene.triangles.push_back({{point(i, j), point(i + 1, j + 1), point(i, j + 1)}, 0});
        }
    std::shuffle(scene.triangles.begin(), scene.triangles.end(), std::mt19937(1));
    return scene;
}

} // namespace bench
