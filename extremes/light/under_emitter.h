#pragma once

// A floor under a small emitter.

#include "extremes/random.h"
#include "scenes/scene.h"

#include <cstdint>

namespace extremes {

constexpr double fov_of_emitter = 1e-7; // the pixel sees nearly a point
constexpr double albedo_under_emitter = 0.5;

/// A square floor around a point, triangles 0 and 1, and over it an emitter, triangles 2 and 3.
struct UnderEmitter {
    scenes::Scene scene;
    double radiance; // that the eye sees: of the floor in the middle
};

/// A square of the given size at a distance of 0.5 to 0.85 from the middle of the floor, at least 30
/// degrees above the horizon, turned away by up to 60 degrees. Its power is pi watts: radiance 1 /
/// size^2.
UnderEmitter under_square(double size, Random& random);

} // namespace extremes
