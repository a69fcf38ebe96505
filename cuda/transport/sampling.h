#pragma once

// Points and directions from uniform numbers. The densities are those of the reference; where a
// density is needed as a number, it is computed at that place.

#include "cuda/parallel/vec.h"

#include <cmath>
#include <numbers>

namespace fast {

using Rgb = Vec3; // linear, Rec.709 primaries

constexpr float pi = std::numbers::pi_v<float>;
constexpr float inverse_pi = std::numbers::inv_pi_v<float>;

HD inline bool is_black(const Rgb& c)
{
    return c.x == 0 && c.y == 0 && c.z == 0;
}

/// An orthonormal right-handed basis around a unit vector z [Duff et al. 2017].
struct Frame {
    Vec3 x, y, z;

    HD explicit Frame(const Vec3& unit_z) : z(unit_z)
    {
        const float sign = std::copysign(1.0f, z.z);
        const float a = -1.0f / (sign + z.z);
        const float b = z.x * z.y * a;
        x = Vec3(1.0f + sign * z.x * z.x * a, sign * b, -sign * z.x);
        y = Vec3(b, sign + z.y * z.y * a, -z.y);
    }
    [[nodiscard]] HD Vec3 to_world(const Vec3& v_local) const
    {
        return v_local.x * x + v_local.y * y + v_local.z * z;
    }
    [[nodiscard]] HD Vec3 to_local(const Vec3& v) const
    {
        return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)};
    }
};

/// radius (cos phi, sin phi), where phi is `u` of a full turn. The angle is reduced by symmetry before
/// it is rounded, because near a full turn 2 pi u would lose three bits of u.
HD inline void on_circle(float radius, float u, float& x, float& y)
{
    const float turn = u < 0.5f ? u : u - 1.0f; // exact
    x = radius * std::cos(2.0f * pi * turn);
    y = radius * std::sin(2.0f * pi * turn);
}

/// A direction of the hemisphere z > 0 with density cos(theta) / pi [Malley's method].
HD inline Vec3 sample_cosine_hemisphere(float u1, float u2)
{
    Vec3 w(0, 0, std::sqrt(1.0f - u1)); // u1 < 1, so w is never in the plane
    on_circle(std::sqrt(u1), u2, w.x, w.y);
    return w;
}

/// A uniform direction: z is uniform in [-1, 1].
HD inline Vec3 sample_sphere(float u1, float u2)
{
    Vec3 w(0, 0, 1.0f - 2.0f * u1);
    on_circle(2.0f * std::sqrt(u1 * (1.0f - u1)), u2, w.x, w.y);
    return w;
}

constexpr float pdf_solid_angle_sphere = inverse_pi / 4.0f;

/// The density per area, at the point that a direction leads to, of a direction with density
/// `pdf_solid_angle` [Veach 1997, eq. 8.10]. `cosine`: between the direction and the normal at that
/// point. `inverse_distance2`: one over the squared distance; 1 if the density is per area across the
/// direction instead of per solid angle, as for light from infinity.
HD inline float to_area(float pdf_solid_angle, float cosine, float inverse_distance2)
{
    return pdf_solid_angle * cosine * inverse_distance2;
}

/// The weights of the second and the third vertex for a uniform point of a triangle [Turk 1990].
HD inline void sample_triangle(float u1, float u2, float& b1, float& b2)
{
    const float root = std::sqrt(u1);
    b1 = root * (1.0f - u2);
    b2 = root * u2;
}

} // namespace fast
