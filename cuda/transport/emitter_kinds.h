#pragma once

// The kinds of emitters. All code of the fast path that is for one kind only is here.
//
// An emitter is a surface (a triangle or a sphere), a source (a point without extent) or at infinity.
// The code for each of these three classes is in emitter.h and emission.h. To add a kind of light: give
// it data, a name and an enumerator in scenes/ (scene.h, for_each_light.h, kinds.h and the reader).
// Write here its conversion to floats (as_floats, power), and add it to the functions of its class below
// (docs/extending.md).

#include "cuda/transport/needs.h"
#include "cuda/transport/sampling.h"
#include "scenes/kinds.h"
#include "scenes/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <stdexcept>

namespace fast {

using scenes::EmitterKind;

/// One emitter. Lengths are those of the scaled scene (scene_view.h).
template <class F>
struct EmitterOf {
    KindOf<F, EmitterKind> kind;
    WordOf<F> index;   // in the scene, among its kind; of triangles and spheres: the primitive
    F area;            // of a surface; else 0
    F probability;     // of being chosen (emitter_choice.h)
    Vec3Of<F> emitted; // radiance; intensity of a source; irradiance of a directional light
};
using Emitter = EmitterOf<float>;

/// The surfaces that an end of paths lies on which is not a surface itself (the eye, a source): ranges
/// of SceneView::contact_planes and contact_triangles, mostly empty.
struct EndContacts {
    std::uint32_t first_plane, plane_count;
    std::uint32_t first_triangle, triangle_count;
};

/// A source, or a light at infinity.
struct Light {
    Vec3 position;             // of a source
    Vec3 direction;            // unit: in which a directional light travels, or the axis of a spot light
    float versine_cutoff;      // of a spot: 1 - cos of the angle from the axis to the edge of its cone
    float exponent;            // of a spot, at most most_exponent
    EndContacts contacts = {}; // of a source
};

// ---- On the host: power (W, mean of the channels) and the light as floats. `position` is the place in
// the scaled scene.

inline double average(const scenes::Rgb& c)
{
    return (c.x + c.y + c.z) / 3.0;
}

inline double power(const scenes::PointLight& light)
{
    return 4.0 * std::numbers::pi * average(light.intensity);
}

inline Light as_floats(const scenes::PointLight& /*light*/, std::size_t /*index*/, const Vec3& position)
{
    return {position, Vec3(0.0f), 0, 0};
}

/// The intensity times the integral of cos^exponent over the cone, which ends at the horizon at the
/// latest unless the lobe is constant.
inline double power(const scenes::SpotLight& spot)
{
    const double c = spot.exponent > 0.0 ? std::max(0.0, spot.cos_cutoff) : spot.cos_cutoff;
    return 2.0 * std::numbers::pi * (1.0 - std::pow(c, spot.exponent + 1.0)) / (spot.exponent + 1.0) *
           average(spot.intensity);
}

/// The narrowest spot light that floats can hold.
///
/// Directions as floats lie on a grid of about u = 2^-24. So the axis may be tilted by 1.5 u, by which
/// the light moves; and near the edge of a cone of half angle a some grid points are on the wrong side.
/// This changes the power little: relatively by (u/a)^(4/3), which is the error of an area that is
/// measured by counting the points of a grid, and by (8 u / a)^2, because the lengths of unit vectors
/// are rounded, too (versine). For the narrowest cone u/a is 2^-8: less than 1e-3 each. The lobe of an
/// exponent n is about 1/sqrt(n) wide, and that of the largest one 2^-16.
///
/// The versine 1 - c itself is computed from the cosine c of the scene, a double: its rounding, 2^-54,
/// is less than 1e-6 of the versine of the narrowest cone.
constexpr double least_half_angle = 0x1p-16; // 0.00175 degrees for the whole cone
constexpr double most_exponent = 0x1p32;

/// Throws std::invalid_argument for the spot light of that index if floats cannot hold it.
inline void check_spot(const scenes::SpotLight& spot, std::size_t index)
{
    const auto refuse = [&](const char* format, double number, double limit) {
        std::array<char, 160> what{};
        std::snprintf(what.data(), what.size(), format, index + 1, number, limit);
        throw std::invalid_argument(what.data());
    };
    const double half_angle = 2.0 * std::asin(std::sqrt((1.0 - spot.cos_cutoff) / 2.0));
    const auto full_degrees = [](double half) { return half * 360.0 / std::numbers::pi; };
    if (!(half_angle >= least_half_angle))
        refuse("spot light %zu: a cone of %.3g degrees is too narrow for single precision, which holds "
               "%.3g and more",
               full_degrees(half_angle), full_degrees(least_half_angle));
    if (!(spot.exponent <= most_exponent))
        refuse("spot light %zu: an exponent of %.3g is too large for single precision, which holds up "
               "to %.3g",
               spot.exponent, most_exponent);
}

/// 1 - cos of the half angle of the cone that a spot light's directions are drawn in.
///
/// Beyond cos^n < 2^-150 the intensity is 0 as a float. Where that lobe is less than a quarter of the
/// cone, the cone ends with the lobe: otherwise few walks would begin in the lobe, and in few
/// directions, because the numbers u that choose them are multiples of 2^-24. A sum over these in place
/// of the integral errs by half a step, n (1 - c) 2^-25 of the power; now n (1 - c) is at most about 4 *
/// 104. For such a light the density is not that of the reference, and its light walks are other ones.
inline double versine_cutoff(const scenes::SpotLight& spot)
{
    const double cone = 1.0 - spot.cos_cutoff;
    if (!(spot.exponent > 0.0)) return cone;
    const double lobe = -std::expm1(-150.0 * std::numbers::ln2 / spot.exponent);
    return lobe < cone / 4.0 ? lobe : cone;
}

/// Throws as check_spot.
inline Light as_floats(const scenes::SpotLight& light, std::size_t index, const Vec3& position)
{
    check_spot(light, index);
    return {position, Vec3(light.direction), static_cast<float>(versine_cutoff(light)),
            static_cast<float>(light.exponent)};
}

/// `disc_area`: of a disc as wide as the scene.
inline double power(const scenes::DirectionalLight& light, double disc_area)
{
    return disc_area * average(light.irradiance);
}

inline Light as_floats(const scenes::DirectionalLight& light)
{
    return {Vec3(0.0f), Vec3(light.direction), 0, 0};
}

/// Of the environment, whose radiance is given.
inline double power_of_environment(const scenes::Rgb& radiance, double disc_area)
{
    return 4.0 * std::numbers::pi * disc_area * average(radiance);
}

// ---- The three classes, and which kind is in which. Without other lights every emitter is a triangle.

template <Needs needs, class F>
HD MaskOf<F> is_surface(const EmitterOf<F>& emitter)
{
    if constexpr (!needs.other_lights) return true;
    return emitter.kind == EmitterKind::triangle || emitter.kind == EmitterKind::sphere;
}

template <Needs needs, class F>
HD MaskOf<F> at_infinity(const EmitterOf<F>& emitter)
{
    if constexpr (!needs.other_lights) return false;
    return emitter.kind == EmitterKind::directional || emitter.kind == EmitterKind::environment;
}

/// Whether the eye walk can hit the emitter, and a pinhole see it.
template <Needs needs, class F>
HD MaskOf<F> can_be_hit(const EmitterOf<F>& emitter)
{
    if constexpr (!needs.other_lights) return true;
    return is_surface<needs>(emitter) || emitter.kind == EmitterKind::environment;
}

// ---- Sources. Their intensity in a direction is Emitter::emitted times a falloff.

/// 1 - cos of the angle between two unit vectors.
///
/// A cosine near 1 is known to within u = 2^-24, which is all of 1 - cos for an angle of 0.02 degrees.
/// For |a| = 1 + e and |b| = 1 + f, e and f at most 4 u, however,
///     |a - b|^2 / 2 = (1 + e) (1 + f) (1 - cos) + (e - f)^2 / 2:
/// the lengths enter by 8 u relatively and by 8 u^2. The differences of coordinates, the squares and
/// their sum round by 5 u relatively. What is left are the directions of a and b: an angle of d between
/// the true and the rounded one changes 1 - cos by d sin.
HD inline float versine(const Vec3& a, const Vec3& b)
{
    const Vec3 difference = a - b;
    return 0.5f * glm::dot(difference, difference);
}

/// Intensity of a spot light in a direction of its cone, as a fraction of that along the axis; `versine`
/// is that of the angle from the axis. cos^n = exp(n log(1 - versine)).
HD inline float spot_falloff(const Light& spot, float versine)
{
    if (spot.exponent == 0.0f) return 1.0f;
    return versine < 1.0f ? std::exp(spot.exponent * std::log1p(-versine)) : 0.0f; // map: emission-spot
}

/// A direction of a source: the falloff there, and the density with which a light walk takes it.
struct SourceDirection {
    float falloff;
    float pdf_solid_angle;
};

/// Of a spot light, in a direction of its cone. Light walks are uniform in the cone.
HD inline SourceDirection spot_direction(const Light& spot, float versine)
{
    return {spot_falloff(spot, versine), 1.0f / (2.0f * pi * spot.versine_cutoff)};
}

/// For the unit direction `w`. False if the source emits nothing there.
HD inline bool source_direction(const Emitter& emitter, const Light& light, const Vec3& w,
                                SourceDirection& result)
{
    result = {1.0f, pdf_solid_angle_sphere};
    if (emitter.kind == EmitterKind::spot) {
        const float off_axis = versine(light.direction, w);
        if (!(off_axis < light.versine_cutoff)) return false;
        result = spot_direction(light, off_axis);
    }
    return true;
}

/// Draws the direction of a light walk. Directions of a point light are uniform, those of a spot light
/// uniform in its cone.
HD inline Vec3 sample_source_direction(const Emitter& emitter, const Light& light, float u1, float u2,
                                       SourceDirection& result)
{
    result = {1.0f, pdf_solid_angle_sphere};
    if (emitter.kind != EmitterKind::spot) return sample_sphere(u1, u2); // map: emission-point
    const float off_axis = u1 * light.versine_cutoff; // 1 - cos(theta); map: emission-spot
    Vec3 w_local(0.0f, 0.0f, 1.0f - off_axis);
    on_circle(std::sqrt(off_axis * (2.0f - off_axis)), u2, w_local.x, w_local.y);
    // The falloff of the angle as drawn: the direction may round out of the cone, and no power may be
    // lost.
    result = spot_direction(light, off_axis);
    return glm::normalize(Frame(light.direction).to_world(w_local));
}

// ---- At infinity.

/// Draws the unit direction from the scene to the light.
HD inline Vec3 sample_towards(const Emitter& emitter, const Light& light, float u1, float u2)
{
    // map: emission-directional, emission-environment
    return emitter.kind == EmitterKind::environment ? sample_sphere(u1, u2) : -light.direction;
}

/// Its density: per solid angle, or 1, a probability, where the direction is certain.
template <class F>
HD F pdf_towards(const EmitterOf<F>& emitter)
{
    return select(emitter.kind == EmitterKind::environment, F(pdf_solid_angle_sphere), F(1.0f));
}

} // namespace fast
