#pragma once

// Points and directions from uniform numbers, each with its density. The name of a density says its
// measure: pdf_area (m^-2), pdf_solid_angle (sr^-1).

#include "ref/trees/ray.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ref {

inline constexpr double pi = std::numbers::pi;
inline constexpr double inverse_pi = std::numbers::inv_pi;

/// An orthonormal right-handed basis around a unit vector z [Duff 2017].
struct Frame {
    Vec3 x, y, z;

    explicit Frame(const Vec3& unit_z) : z(unit_z)
    {
        const double sign = std::copysign(1.0, z.z);
        const double a = -1.0 / (sign + z.z);
        const double b = z.x * z.y * a;
        x = Vec3(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x);
        y = Vec3(b, sign + z.y * z.y * a, -z.y);
    }
    [[nodiscard]] Vec3 to_world(const Vec3& v_local) const
    {
        return v_local.x * x + v_local.y * y + v_local.z * z;
    }
    [[nodiscard]] Vec3 to_local(const Vec3& v) const
    {
        return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)};
    }
};

/// A direction of the hemisphere z > 0 with density cos(theta) / pi: a uniform point of the unit disc,
/// projected up to the sphere [Malley's method].
inline Vec3 sample_cosine_hemisphere(double u1, double u2)
{
    const double radius = std::sqrt(u1);
    const double phi = 2.0 * pi * u2;
    return {radius * std::cos(phi), radius * std::sin(phi), std::sqrt(1.0 - u1)}; // map: cosine-sampling
}

inline double pdf_solid_angle_cosine_hemisphere(const Vec3& w_local)
{
    return std::max(0.0, w_local.z) * inverse_pi;
}

/// A uniform direction: z is uniform in [-1, 1] (Archimedes).
inline Vec3 sample_sphere(double u1, double u2)
{
    const double z = 1.0 - 2.0 * u1;
    const double radius = 2.0 * std::sqrt(u1 * (1.0 - u1)); // = sqrt(1 - z^2) without cancellation
    const double phi = 2.0 * pi * u2;
    return {radius * std::cos(phi), radius * std::sin(phi), z};
}

inline constexpr double pdf_solid_angle_sphere = inverse_pi / 4.0;

/// Barycentric coordinates of a uniform point of a triangle [Turk 1990].
inline Vec3 sample_triangle(double u1, double u2)
{
    const double root = std::sqrt(u1);
    return {1.0 - root, root * (1.0 - u2), root * u2}; // map: emission-triangle [Turk 1990]
}

/// A uniform point of the unit disc.
inline glm::dvec2 sample_disc(double u1, double u2)
{
    const double radius = std::sqrt(u1);
    return {radius * std::cos(2.0 * pi * u2), radius * std::sin(2.0 * pi * u2)};
}

/// The largest of three components.
inline double max_component(const Rgb& v)
{
    return std::max({v.x, v.y, v.z});
}

} // namespace ref
