#pragma once

// Points and directions from uniform numbers. The densities are those of the reference; where a
// density is needed as a number, it is computed at that place.

#include "cuda/parallel/number.h"

#include <numbers>

namespace fast {

using Rgb = Vec3; // linear, Rec.709 primaries

constexpr float pi = std::numbers::pi_v<float>;
constexpr float inverse_pi = std::numbers::inv_pi_v<float>;

template <class F>
HD MaskOf<F> is_black(const Vec3Of<F>& c)
{
    return c.x == 0.0f && c.y == 0.0f && c.z == 0.0f;
}

/// An orthonormal right-handed basis around a unit vector z [Duff et al. 2017].
template <class F>
struct FrameOf {
    Vec3Of<F> x, y, z;

    HD explicit FrameOf(const Vec3Of<F>& unit_z) : z(unit_z)
    {
        const F sign = with_sign_of(F(1.0f), z.z);
        const F a = -1.0f / (sign + z.z);
        const F b = z.x * z.y * a;
        x = Vec3Of<F>(1.0f + sign * z.x * z.x * a, sign * b, -sign * z.x);
        y = Vec3Of<F>(b, sign + z.y * z.y * a, -z.y);
    }
    [[nodiscard]] HD Vec3Of<F> to_world(const Vec3Of<F>& v_local) const
    {
        return v_local.x * x + v_local.y * y + v_local.z * z;
    }
    [[nodiscard]] HD Vec3Of<F> to_local(const Vec3Of<F>& v) const
    {
        return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)};
    }
};
using Frame = FrameOf<float>;

/// radius (cos phi, sin phi), where phi is `u` of a full turn, 0 <= u < 1 in steps of 2^-24.
///
/// The turn is parted into its nearest quarter and a rest, both exactly, because near a full turn 2 pi u
/// would lose three bits of u. Within an eighth of a turn the two polynomials [Moshier, Cephes: sinf.c]
/// err by less than 2^-24 (tests/cuda/transport/sampling_test.cpp). Unlike the functions of a library
/// they are the same for one number and for many.
template <class F>
HD void on_circle(const F& radius, const F& u, F& x, F& y)
{
    const WordOf<F> quarter = to_word(4.0f * u + 0.5f);
    const F f = (4.0f * u - to_float(quarter)) * (0.5f * pi);
    const F f2 = f * f;
    const F sine = f + f * f2 * (-1.6666654611e-1f + f2 * (8.3321608736e-3f + f2 * -1.9515295891e-4f));
    const F cosine =
        1.0f - 0.5f * f2 +
        f2 * f2 * (4.166664568298827e-2f + f2 * (-1.388731625493765e-3f + f2 * 2.443315711809948e-5f));
    const MaskOf<F> odd = (quarter & WordOf<F>(1u)) != WordOf<F>(0u);
    const F across = select(odd, sine, cosine);
    const F up = select(odd, cosine, sine);
    x = radius * select(((quarter + WordOf<F>(1u)) & WordOf<F>(2u)) != WordOf<F>(0u), -across, across);
    y = radius * select((quarter & WordOf<F>(2u)) != WordOf<F>(0u), -up, up);
}

/// A direction of the hemisphere z > 0 with density cos(theta) / pi [Malley's method].
template <class F>
HD Vec3Of<F> sample_cosine_hemisphere(const F& u1, const F& u2)
{
    Vec3Of<F> w(F(0.0f), F(0.0f), square_root(1.0f - u1)); // u1 < 1, so w is never in the plane
    on_circle(square_root(u1), u2, w.x, w.y);              // map: cosine-sampling
    return w;
}

/// A uniform direction: z is uniform in [-1, 1].
template <class F>
HD Vec3Of<F> sample_sphere(const F& u1, const F& u2)
{
    Vec3Of<F> w(F(0.0f), F(0.0f), 1.0f - 2.0f * u1);
    on_circle(2.0f * square_root(u1 * (1.0f - u1)), u2, w.x, w.y);
    return w;
}

constexpr float pdf_solid_angle_sphere = inverse_pi / 4.0f;

/// The density per area, at the point that a direction leads to, of a direction with density
/// `pdf_solid_angle` [Veach 1997, eq. 8.10]. `cosine`: between the direction and the normal at that
/// point. `inverse_distance2`: one over the squared distance; 1 if the density is per area across the
/// direction instead of per solid angle, as for light from infinity.
template <class F>
HD F to_area(const F& pdf_solid_angle, const F& cosine, const F& inverse_distance2)
{
    return pdf_solid_angle * cosine * inverse_distance2; // map: area-conversion
}

/// The weights of the second and the third vertex for a uniform point of a triangle [Turk 1990].
template <class F>
HD void sample_triangle(const F& u1, const F& u2, F& b1, F& b2)
{
    const F root = square_root(u1);
    b1 = root * (1.0f - u2); // map: emission-triangle
    b2 = root * u2;
}

} // namespace fast
