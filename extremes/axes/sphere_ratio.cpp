// A small sphere beside a large one.

#include "extremes/axes/axes.h"
#include "extremes/leave/leave_case.h"
#include "extremes/leave/shapes.h"
#include "extremes/spheres/sphere_rays.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace extremes {

namespace {

/// The large sphere has the diameter 1, the small one is 1.25 from its centre, and the eye 4, on the
/// same side.
TwoRays small_beside_large(double ratio, Random& random)
{
    const scenes::Sphere large{0.01 * random.direction(), 0.5, 0};
    const scenes::Vec3 to_eye = random.direction();
    const scenes::Sphere small{1.25 * direction_near(to_eye, 0.7, random), 0.5 / ratio, 0};
    const scenes::Vec3 eye = 4.0 * to_eye;
    TwoRays rays{scene_of_spheres({large, small}, eye),
                 1,
                 {},
                 small.radius,
                 scenes::Vec3(0.0),
                 false,
                 std::nullopt,
                 {},
                 small.radius};
    const scenes::Vec3 normal = direction_near(glm::normalize(eye - small.center), 0.7, random);
    rays.first_point = point_of_sphere(small, ExactVec3(normal));
    switch (random.below(3)) {
    case 0: { // through the small sphere, to a point that is more than a right angle away
        scenes::Vec3 other = random.direction();
        if (glm::dot(other, normal) > 0) other = -other;
        rays.inward = true;
        rays.second = 1;
        rays.second_point = point_of_sphere(small, ExactVec3(other));
        rays.onward = rounded_unit(rays.second_point - rays.first_point);
        break;
    }
    case 1: { // to the large sphere, if that is not behind the small one; or else away from it
        const scenes::Vec3 back = glm::normalize(small.center - large.center);
        rays.second_point = point_of_sphere(large, ExactVec3(direction_near(back, 0.3, random)));
        rays.second_length = large.radius;
        rays.onward = rounded_unit(rays.second_point - rays.first_point);
        if (glm::dot(rays.onward, normal) > 0.1)
            rays.second = 0;
        else
            rays.onward = -rays.onward;
        if (glm::dot(rays.onward, normal) < 0.1) rays.onward = normal;
        break;
    }
    default: // away from both
        rays.onward = direction_near(normal, 0.9, random);
        if (glm::dot(rays.onward, small.center - large.center) < 0) rays.onward = normal;
    }
    return rays;
}

/// The same for the usual tricks: the light always goes through the small sphere.
LeaveCase leaving_small_sphere(double ratio, Random& random, int rays)
{
    LeaveCase result{grey_scene(), {}, 0.5 / ratio};
    const scenes::Vec3 to_eye = random.direction();
    const scenes::Sphere small{1.25 * direction_near(to_eye, 0.7, random), 0.5 / ratio, 0};
    result.scene.spheres = {{0.01 * random.direction(), 0.5, 0}, small};
    const scenes::Vec3 eye = 4.0 * to_eye;
    while (static_cast<int>(result.rays.size()) < rays) {
        const scenes::Vec3 normal = direction_near(glm::normalize(eye - small.center), 0.7, random);
        scenes::Vec3 other = random.direction();
        if (glm::dot(other, normal) > 0) other = -other;
        result.rays.push_back({eye, direction_between(eye, small.center + small.radius * normal), 1,
                               glm::normalize(other - normal)});
    }
    return result;
}

// Lengths are multiples of the radius r of the small sphere; the ratio is k. The eye is 8 k from the
// centre of the large sphere and D <= 6.5 k from the small one. To first order in u:
//
// 1. The first point, as for a far eye (axes/far_camera.cpp, step 3). The ray is moved across by the
//    rounding of its direction and of f, u D each, and in single precision of the eye, 8 u k. The
//    computation of t moves the point by 12 u D along the ray, which is 0.7 of it along the surface, and
//    the product by u D. The rounded centre moves by 2.5 u k, and the sum c + r n is rounded by as much.
// 2. The ray inward starts at the point moved by its clearance: 2 u |p| <= 5 u k (and 56 u; 13 u in
//    double), and rounded, 2.5 u k. It leaves the sphere where the normal is at no more than 45 degrees
//    to it. So its end is displaced by sqrt(2) times as much. The sums add 2 u |p| = 5 u k.
// The end on the large sphere errs by less, relative to that sphere.
double bound_of_sphere_ratio(Format format, double ratio)
{
    const bool is_double = format == Format::binary64;
    const double u = unit_roundoff(format);
    const double across = (2 * 6.5 + (is_double ? 0 : 8)) / 0.714;
    const double first = (across + (12 * 0.7 + 1) * 6.5 + 5) * ratio + 10;
    return 1.01 * u * (std::sqrt(2.0) * (first + 7.5 * ratio + 60) + 5 * ratio);
}

} // namespace

Axis sphere_ratio_axis()
{
    Axis axis;
    axis.number = 5;
    axis.name = "sphere-ratio";
    axis.title = "Ratio of two radii";
    axis.parameter = "radius of the large sphere over that of the small one";
    axis.about =
        "The large sphere has a diameter of 1; the small one is beside it. A ray from the eye, four "
        "diameters away, is aimed at the small sphere, and a second ray goes on from there: through the "
        "small sphere, as in glass, or to the large one, or away from both. The error is the distance "
        "of a point that is met from the true one, relative to the radius of its sphere. The truth is "
        "the points themselves, which the rays would meet without rounding. With the usual tricks the "
        "light always goes through the small sphere, and the error is that of the distance it goes.";
    axis.ordinary = 1;
    axis.logarithmic = true;
    axis.values = powers_of_ten(0, 16, 0.5);
    axis.most_cases = 50'000; // a scene and its tree each
    axis.methods = methods_of_two_rays(small_beside_large);
    for (Method& trick : leave_tricks(leaving_small_sphere, false))
        axis.methods.push_back(std::move(trick));
    axis.shared_truth = true;
    const std::string because =
        "the centre of the small sphere, the eye and the start of the second ray "
        "are rounded to 2^-24 (2^-53 in double) of a large number";
    axis.limits = {{"ref", 6.5e11, [](double x) { return bound_of_sphere_ratio(Format::binary64, x); },
                    8e12, Failure::inaccurate, because},
                   {"host", 1050, [](double x) { return bound_of_sphere_ratio(Format::binary32, x); },
                    1.5e4, Failure::inaccurate, because}};
    axis.derivation =
        "let k be the ratio of the radii. Lengths are in radii of the small sphere: the eye, the "
        "centre and the differences are rounded to u times up to 8 k, the quotient that gives the "
        "distance to 12 u times 6.5 k, and the ray onward starts at a clearance of 5 u k. The "
        "displacements across the ray and along it, with the cosines, add up to 135 u k (151 u k "
        "in single precision).";
    return axis;
}

} // namespace extremes
