#pragma once

// An ordinary scene with a point light far away from it.

#include "extremes/exact.h"
#include "extremes/random.h"

#include <cstdint>
#include <vector>

namespace extremes {

constexpr int points_of_far_light = 10;
constexpr double least_far_cosine = 0.25; // between the light and the normal

/// A square floor with a sphere over it, of diameter 1 together, and a point light whose irradiance at
/// the middle of the floor is 1 on a surface that faces it.
struct FarLight {
    scenes::Scene scene;
    struct OnFloor {
        std::uint32_t triangle;
        double b1, b2;
        bool lit;
        Exact irradiance; // if lit
    };
    std::vector<OnFloor> points;
};

/// With random points of the floor. The light is at `distance` from the middle of the floor.
FarLight far_light(double distance, Random& random);

} // namespace extremes
