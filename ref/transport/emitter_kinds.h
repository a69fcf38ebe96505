#pragma once

// The kinds of emitters. All code of the reference that is for one kind only is here.
//
// An emitter is a surface (a triangle or a sphere), a source (a point without extent) or at infinity.
// The code for each of these three classes is in emitter.cpp and emission.cpp. A kind of source has four
// functions here, a kind at infinity three. To add a kind of light: give it data, a name and an
// enumerator in scenes/ (scene.h, for_each_light.h, kinds.h and the reader), write its functions here,
// and list it in visit_source or visit_distant (docs/extending.md).

#include "ref/transport/sampling.h"
#include "scenes/kinds.h"
#include "scenes/scene.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ref {

using scenes::EmitterKind;

/// Mean of the three channels: powers are compared by it.
inline double average(const Rgb& v)
{
    return (v.x + v.y + v.z) / 3.0;
}

// ---- Sources: power (W), intensity (W sr^-1) in the unit direction w, and the directions of light
// walks.

inline double power(const scenes::PointLight& light)
{
    return 4.0 * pi * average(light.intensity);
}

inline Rgb intensity(const scenes::PointLight& light, const Vec3& /*w*/)
{
    return light.intensity;
}

inline Vec3 sample_direction(const scenes::PointLight& /*light*/, double u1, double u2)
{
    return sample_sphere(u1, u2); // map: emission-point
}

inline double pdf_solid_angle_direction(const scenes::PointLight& /*light*/, const Vec3& /*w*/)
{
    return pdf_solid_angle_sphere;
}

/// Integral of cos^n over the cone: 2 pi (1 - c^(n+1)) / (n+1), where the lobe ends at the horizon at
/// the latest unless it is constant.
inline double power(const scenes::SpotLight& light)
{
    const double c = light.exponent > 0.0 ? std::max(0.0, light.cos_cutoff) : light.cos_cutoff;
    const double solid_angle =
        2.0 * pi * (1.0 - std::pow(c, light.exponent + 1.0)) / (light.exponent + 1.0);
    return solid_angle * average(light.intensity);
}

inline Rgb intensity(const scenes::SpotLight& light, const Vec3& w)
{
    const double cosine = glm::dot(light.direction, w);
    if (cosine <= light.cos_cutoff) return Rgb(0.0);
    if (light.exponent == 0.0) return light.intensity;
    // map: emission-spot
    return cosine > 0.0 ? light.intensity * std::pow(cosine, light.exponent) : Rgb(0.0);
}

/// Uniform in the cone.
inline Vec3 sample_direction(const scenes::SpotLight& light, double u1, double u2)
{
    const double z = 1.0 - u1 * (1.0 - light.cos_cutoff); // map: emission-spot
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    const double phi = 2.0 * pi * u2;
    return Frame(light.direction).to_world({radius * std::cos(phi), radius * std::sin(phi), z});
}

inline double pdf_solid_angle_direction(const scenes::SpotLight& light, const Vec3& w)
{
    const bool inside = glm::dot(light.direction, w) > light.cos_cutoff;
    return inside ? 1.0 / (2.0 * pi * (1.0 - light.cos_cutoff)) : 0.0;
}

// ---- At infinity: power (W) that falls on a disc as wide as the scene (m^2), the emitted radiance or
// irradiance, and the direction from the scene to the light.

inline double power(const scenes::DirectionalLight& light, double disc_area)
{
    return disc_area * average(light.irradiance);
}

/// Irradiance (W m^-2) on a surface that faces the light.
inline Rgb emitted(const scenes::DirectionalLight& light)
{
    return light.irradiance;
}

inline Vec3 sample_towards(const scenes::DirectionalLight& light, double /*u1*/, double /*u2*/)
{
    return -light.direction; // map: emission-directional
}

/// The same radiance (W m^-2 sr^-1) from every direction.
struct Environment {
    Rgb radiance;
};

inline double power(const Environment& environment, double disc_area)
{
    return 4.0 * pi * disc_area * average(environment.radiance);
}

inline Rgb emitted(const Environment& environment)
{
    return environment.radiance;
}

inline Vec3 sample_towards(const Environment& /*environment*/, double u1, double u2)
{
    return sample_sphere(u1, u2); // map: emission-environment
}

// ---- The three classes, and which kind is in which.

constexpr bool is_surface(EmitterKind kind)
{
    return kind == EmitterKind::triangle || kind == EmitterKind::sphere;
}

constexpr bool is_at_infinity(EmitterKind kind)
{
    return kind == EmitterKind::directional || kind == EmitterKind::environment;
}

/// Whether a ray can meet the emitter by chance: its position or its direction is not a single one.
constexpr bool can_be_hit(EmitterKind kind)
{
    return is_surface(kind) || kind == EmitterKind::environment;
}

/// The density with which sample_towards gives a direction: per solid angle, or 1, a probability, where
/// the direction is certain.
constexpr double pdf_towards(EmitterKind kind)
{
    return kind == EmitterKind::environment ? pdf_solid_angle_sphere : 1.0;
}

/// Calls f(light) with a source: the `index`-th light of its kind.
template <class Function>
auto visit_source(const scenes::Scene& scene, EmitterKind kind, std::uint32_t index, const Function& f)
{
    switch (kind) {
    case EmitterKind::point:
        return f(scene.point_lights[index]);
    case EmitterKind::spot:
        return f(scene.spot_lights[index]);
    default:
        throw std::logic_error("this emitter is not a source");
    }
}

/// The same for an emitter at infinity.
template <class Function>
auto visit_distant(const scenes::Scene& scene, EmitterKind kind, std::uint32_t index, const Function& f)
{
    switch (kind) {
    case EmitterKind::directional:
        return f(scene.directional_lights[index]);
    case EmitterKind::environment:
        return f(Environment{*scene.environment});
    default:
        throw std::logic_error("this emitter is not at infinity");
    }
}

} // namespace ref
