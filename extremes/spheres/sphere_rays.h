#pragma once

// A ray to a surface and another one onward from there, with the points that they meet without rounding.

#include "extremes/axis.h"
#include "extremes/exact.h"

#include <functional>
#include <optional>

namespace extremes {

/// A case. The first ray starts at the eye of the scene's camera.
struct TwoRays {
    scenes::Scene scene;
    std::uint32_t first; // the primitive that the first ray meets
    ExactVec3 first_point;
    double first_length;                 // that the error of this point is relative to
    scenes::Vec3 onward;                 // unit length
    bool inward;                         // whether it goes to the inner side of the first primitive
    std::optional<std::uint32_t> second; // the primitive that the second ray meets
    ExactVec3 second_point;
    double second_length;
};

using TwoRaysDraw = std::function<TwoRays(double parameter, Random& random)>;

/// "ref" and "host" on cases from `draw`. The error is the larger of those of the two points.
///
/// Failure::missed: the first ray does not meet its surface, or the second one meets nothing in its way
/// to another surface. Failure::self_hit: the second ray meets the surface that it leaves.
/// Failure::leaked: a ray inward does not meet the surface that it is inside of. Failure::wrong_order:
/// a ray meets another surface than it should.
std::vector<Method> methods_of_two_rays(const TwoRaysDraw& draw);

/// The point of the sphere in the direction of `towards` from its centre.
ExactVec3 point_of_sphere(const scenes::Sphere& sphere, const ExactVec3& towards);

/// A unit vector at an angle to the unit vector `axis` of which the sine is at most `largest_sine`.
scenes::Vec3 direction_near(const scenes::Vec3& axis, double largest_sine, Random& random);

/// A scene of spheres, of one material, with an eye.
scenes::Scene scene_of_spheres(std::vector<scenes::Sphere> spheres, const scenes::Vec3& eye);

} // namespace extremes
