// A huge sphere as a floor.

#include "extremes/axes/axes.h"
#include "extremes/leave/leave_case.h"
#include "extremes/leave/shapes.h"
#include "extremes/spheres/sphere_rays.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace extremes {

namespace {

/// A sphere of radius 1 hovers half a radius over a floor, which passes near the origin and is a sphere
/// of radius `ratio`. The eye is 3 above the floor. The first ray goes to the floor, up to 3 away from
/// the sphere.
TwoRays sphere_over_sphere(double ratio, Random& random)
{
    const scenes::Vec3 up = random.direction();
    const scenes::Sphere floor{-ratio * up, ratio, 0};
    const scenes::Sphere sphere{1.5 * up, 1.0, 0};
    const scenes::Vec3 x = glm::normalize(glm::cross(up, random.direction()));
    // Directly under the sphere the floor is not seen from here.
    const scenes::Vec3 eye = 3.0 * up + 3.5 * x;
    TwoRays rays{
        scene_of_spheres({floor, sphere}, eye), 0, {}, 1, scenes::Vec3(0.0), false, std::nullopt, {}, 1};
    const scenes::Vec3 below =
        2.5 * x + random.between(-1, 1) * glm::cross(up, x) + random.between(-0.5, 0.5) * x;
    rays.first_point = point_of_sphere(floor, ExactVec3(below) - ExactVec3(floor.center));
    const scenes::Vec3 from(rays.first_point.x.to_double(), rays.first_point.y.to_double(),
                            rays.first_point.z.to_double());
    const scenes::Vec3 normal = glm::normalize(from - floor.center);
    switch (random.below(3)) {
    case 0: // to the sphere
        rays.second = 1;
        rays.second_point = point_of_sphere(
            sphere, ExactVec3(direction_near(glm::normalize(from - sphere.center), 0.7, random)));
        rays.onward = rounded_unit(rays.second_point - rays.first_point);
        break;
    case 1: // through the floor, as in glass, to a point that is more than a right angle away
    {
        scenes::Vec3 other = random.direction();
        if (glm::dot(other, normal) > 0) other = -other;
        rays.inward = true;
        rays.second = 0;
        rays.second_length = ratio;
        rays.second_point = point_of_sphere(floor, ExactVec3(other));
        rays.onward = rounded_unit(rays.second_point - rays.first_point);
        break;
    }
    default: { // away from both
        rays.onward = direction_near(normal, 0.9, random);
        const scenes::Vec3 to_center = sphere.center - from;
        if (glm::length(glm::cross(to_center, rays.onward)) < 1.1) rays.onward = normal;
    }
    }
    return rays;
}

/// The same for the usual tricks: the light always goes on to the small sphere.
LeaveCase leaving_sphere_floor(double ratio, Random& random, int rays)
{
    LeaveCase result{grey_scene(), {}, 1.0};
    const scenes::Vec3 up = random.direction();
    const scenes::Vec3 x = glm::normalize(glm::cross(up, random.direction()));
    const scenes::Vec3 y = glm::cross(up, x);
    const scenes::Vec3 center = 1.5 * up;
    result.scene.spheres = {{-ratio * up, ratio, 0}, {center, 1.0, 0}};
    for (int i = 0; i < rays; ++i) {
        const scenes::Vec3 across = random.between(2.0, 3.0) * x + random.between(-1, 1) * y;
        // On the floor: R - sqrt(R^2 - r^2) below its top, without cancellation.
        const double r2 = glm::dot(across, across);
        const scenes::Vec3 from = across - r2 / (ratio + std::sqrt(ratio * ratio - r2)) * up;
        const scenes::Vec3 eye = 3.0 * up + 3.5 * x;
        const scenes::Vec3 target = center + direction_near(glm::normalize(from - center), 0.7, random);
        result.rays.push_back({eye, direction_between(eye, from), 0, direction_between(from, target)});
    }
    return result;
}

// Lengths are in radii of the small sphere. R is the radius of the floor and the largest coordinate up
// to a few units, which the sum R + 4 covers. To first order in u:
//
// 1. The first point. The hit is within 22 u M of the floor, M = 2 R (cuda/trees/sphere.h; the reference
//    computes the same). The angle between the ray and the normal has a tangent of at most 0.85, and the
//    point is moved to the floor along the normal: 44 u R 0.85 = 37 u R along the floor. The sum of the
//    origin and t d and the difference to the centre have u R each, the product r n has 6 u R and the
//    sum with the centre 2 u R: 47 u R. In single precision the eye, the centre and the radius are
//    rounded, which moves the point by 3 u R: 50 u R.
// 2. The second ray starts at the clearance: 56 u R + 2 u R in single precision; 5 + 14 + 2 u R in
//    double. Its origin is rounded, u R. Together: 109 u R, and 69 u R in double.
// 3. On the small sphere, the point is displaced by 1 / cos of this, cos >= 0.71, and by the rounding of
//    the sums with its centre, 2 u R, and in single precision of the centre itself: 157 u R, and 100 u R
//    in double. The errors of its own test are less than 250 u.
// The far side of the floor errs by less, relative to its radius.
double bound_of_sphere_floor(Format format, double ratio)
{
    const bool is_double = format == Format::binary64;
    const double u = unit_roundoff(format);
    return 1.01 * u * ((is_double ? 100 : 157) * (ratio + 4) + 250);
}

} // namespace

Axis sphere_floor_axis()
{
    Axis axis;
    axis.number = 5;
    axis.name = "sphere-floor";
    axis.title = "A sphere as a floor";
    axis.parameter = "radius of the floor over that of the sphere above it";
    axis.about =
        "A sphere hovers over a floor that is a sphere itself, of the radius that the parameter tells. "
        "A "
        "ray from the eye is aimed at the floor beside the small sphere, and a second ray goes on from "
        "there: to the small sphere, or away from both, or through the floor, as in glass. The error is "
        "the distance of a point that is met from the true one, relative to the radius of the small "
        "sphere, but for the far side of the floor relative to that of the floor. The truth is the "
        "points themselves, which the rays would meet without rounding. With the usual tricks the light "
        "always goes on to the small sphere, and the error is that of the distance it goes.";
    axis.ordinary = 10;
    axis.logarithmic = true;
    axis.values = powers_of_ten(1, 16, 0.5);
    axis.most_cases = 50'000; // a scene and its tree each
    axis.methods = methods_of_two_rays(sphere_over_sphere);
    for (Method& trick : leave_tricks(leaving_sphere_floor, false))
        axis.methods.push_back(std::move(trick));
    axis.shared_truth = true;
    const std::string because =
        "near the floor coordinates and distances from its centre are rounded to 2^-24 (2^-53 in "
        "double) "
        "of its radius, and a ray that leaves it starts at a distance of 58 (22) such roundings";
    axis.limits = {{"ref", 8.5e11, [](double x) { return bound_of_sphere_floor(Format::binary64, x); },
                    3e12, Failure::inaccurate, because},
                   {"host", 1000, [](double x) { return bound_of_sphere_floor(Format::binary32, x); },
                    2500, Failure::inaccurate, because}};
    axis.derivation =
        "let R be the radius of the floor. A hit is within 22 u of twice R of the floor, and "
        "moves along it by up to 37 u R; sums with the centre add 10 u R, and the rounding of the "
        "input 3 u R in single precision. The second ray starts at a clearance of 58 u R (22 u R "
        "in double). On the small sphere that is at most 100 u R, or 157 u R in single precision.";
    return axis;
}

} // namespace extremes
