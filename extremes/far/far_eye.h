#pragma once

// An ordinary scene with an eye far away from it.

#include "extremes/exact.h"
#include "extremes/random.h"

#include <vector>

namespace extremes {

constexpr int rays_of_far_eye = 10;
constexpr double far_sphere_sine = 0.7; // of the angle between its normals and the eye, at most

/// A cube or a sphere of diameter 1 (of the sphere: the diagonal of its box) with an eye, and points of
/// it that the eye sees.
struct FarEye {
    scenes::Scene scene;
    std::vector<ExactVec3> targets;
};

/// The eye is at `distance` from the origin, which is near the middle of the scene. The targets are
/// random points of the cube, on the side that faces the eye, or of the sphere, within far_sphere_sine
/// of its outline.
FarEye far_eye(double distance, Random& random);

} // namespace extremes
