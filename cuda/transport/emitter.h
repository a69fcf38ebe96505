#pragma once

// Where light comes from: choosing an emitter, and drawing light for a point (next event). How light
// walks begin is in emission.h. Densities are those of the reference. Two of them have the measure of
// their emitter:
//
//   emitter             pdf_position of y_0      pdf_direction from y_0
//   triangle, sphere    per area                 per solid angle
//   point, spot         a probability            per solid angle
//   directional         a probability            per area across the direction
//   environment         per solid angle          per area across the direction
//
// pdf_position contains the probability of choosing the emitter. Of an emitter at infinity, y_0 is a
// direction. Areas are those of the scaled scene (scene_view.h).

#include "cuda/transport/contacts.h"
#include "cuda/transport/scene_view.h"
#include "cuda/transport/surface_point.h"

namespace fast {

/// The number of the emitter that `u` in [0, 1) falls on: the first whose sum exceeds u. Emitters of no
/// power are never chosen. There must be one that has some.
template <Needs needs>
HD std::uint32_t choose_emitter(const SceneView<needs>& scene, float u)
{
    std::uint32_t first = 0;
    auto last = static_cast<std::uint32_t>(scene.cumulative.size()) - 1;
    while (first < last) {
        const std::uint32_t middle = (first + last) / 2;
        if (scene.cumulative[middle] > u)
            last = middle;
        else
            first = middle + 1;
    }
    return first;
}

/// Whether the eye walk can run into the emitter, and a pinhole see it.
template <Needs needs>
HD bool can_be_hit(const Emitter& emitter)
{
    if constexpr (!needs.other_lights) return true;
    return emitter.kind == EmitterKind::triangle || emitter.kind == EmitterKind::sphere ||
           emitter.kind == EmitterKind::environment;
}

/// Whether the emitter is infinitely far away.
template <Needs needs>
HD bool at_infinity(const Emitter& emitter)
{
    if constexpr (!needs.other_lights) return false;
    return emitter.kind == EmitterKind::directional || emitter.kind == EmitterKind::environment;
}

/// Whether the emitter is a surface.
template <Needs needs>
HD bool is_surface(const Emitter& emitter)
{
    if constexpr (!needs.other_lights) return true;
    return emitter.kind == EmitterKind::triangle || emitter.kind == EmitterKind::sphere;
}

/// A uniform point on an emitter that is a surface.
template <Needs needs>
HD SurfacePoint sample_surface(const SceneView<needs>& scene, const Emitter& emitter, float u1, float u2)
{
    if constexpr (needs.spheres && needs.other_lights)
        if (emitter.kind == EmitterKind::sphere)
            return sphere_point(scene, emitter.index, sample_sphere(u1, u2));
    float b1 = 0;
    float b2 = 0;
    sample_triangle(u1, u2, b1, b2);
    return triangle_point(scene, emitter.index, b1, b2);
}

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
    return versine < 1.0f ? std::exp(spot.exponent * std::log1p(-versine)) : 0.0f;
}

/// Directions of a spot light are uniform in its cone.
HD inline float pdf_solid_angle_cone(const Light& spot)
{
    return 1.0f / (2.0f * pi * spot.versine_cutoff);
}

/// pdf_position: the density with which the emitter and its y_0 are drawn. 0 for a surface of no area.
template <Needs needs>
HD float pdf_emission_position(const Emitter& emitter)
{
    if (is_surface<needs>(emitter))
        return emitter.area > 0.0f ? emitter.probability / emitter.area : 0.0f;
    return emitter.kind == EmitterKind::environment ? emitter.probability * pdf_solid_angle_sphere
                                                    : emitter.probability;
}

/// The start of a walk from infinity is a uniform point of a disc that covers the scene: the density per
/// area of the disc.
template <Needs needs>
HD float pdf_area_disc(const SceneView<needs>& scene)
{
    return inverse_pi / (scene.radius * scene.radius);
}

/// Light that may reach a point `from`, and all that the weights need of it.
struct IncidentLight {
    std::uint32_t emitter;
    Vec3 wi;            // unit, from the point towards the light
    Rgb alpha;          // emitted towards the point, cosine at the light over squared distance
                        // included, over pdf_position
    float geometry;     // turns a density per solid angle at `from` into one at y_0: the cosine at the
                        // light over squared distance [Veach 1997, eq. 8.10]; 1 at infinity
    float pdf_position; // of y_0
    float pdf_rev_area_across; // with which a light walk at y_0 comes to `from`: per area across wi, so
                               // that times the cosine at `from` it is per area of the surface there
    SurfacePoint end;          // y_0, if it is on a surface
    Vec3 target;               // where the segment to be tested ends, unless at infinity
};

/// Draws light for `from` by the first three numbers of `u`. False if there is none to come from there.
template <Needs needs>
HD bool sample_incident(const SceneView<needs>& scene, const Vec3& from, const Uniforms& u,
                        IncidentLight& light)
{
    light.emitter = choose_emitter(scene, u[0]);
    const Emitter& emitter = scene.emitters[light.emitter];
    light.pdf_position = pdf_emission_position<needs>(emitter);
    if (is_surface<needs>(emitter)) {
        light.end = sample_surface(scene, emitter, u[1], u[2]);
        const Vec3 d = light.end.position - from;
        const float distance2 = glm::dot(d, d);
        const float inverse_distance2 = 1.0f / distance2;
        light.wi = d * std::sqrt(inverse_distance2);
        const float cosine = -glm::dot(light.end.normal, light.wi);
        if (!(cosine > 0.0f) || !(light.pdf_position > 0.0f)) return false; // the dark side
        light.geometry = cosine * inverse_distance2;
        light.pdf_rev_area_across = cosine * inverse_pi * inverse_distance2;
        light.alpha = emitter.emitted * (light.geometry / light.pdf_position);
        light.target =
            end_at_surface(light.end, light.end.normal, distance2 * std::sqrt(inverse_distance2));
        return true;
    }
    if constexpr (needs.other_lights) {
        const Light& source = scene.lights[light.emitter];
        light.geometry = 1.0f;
        light.alpha = emitter.emitted / light.pdf_position;
        if (emitter.kind == EmitterKind::environment) {
            light.wi = sample_sphere(u[1], u[2]);
            light.pdf_rev_area_across = pdf_area_disc(scene);
        } else if (emitter.kind == EmitterKind::directional) {
            light.wi = -source.direction;
            light.pdf_rev_area_across = pdf_area_disc(scene);
        } else {
            const Vec3 d = source.position - from;
            const float distance2 = glm::dot(d, d);
            const float inverse_distance2 = 1.0f / distance2;
            light.wi = d * std::sqrt(inverse_distance2);
            light.target = leave_end(scene, source.position, source.contacts, -d,
                                     distance2 * std::sqrt(inverse_distance2));
            light.alpha *= inverse_distance2;
            float pdf_solid_angle = pdf_solid_angle_sphere;
            if (emitter.kind == EmitterKind::spot) {
                const float off_axis = versine(source.direction, -light.wi);
                if (!(off_axis < source.versine_cutoff)) return false;
                light.alpha *= spot_falloff(source, off_axis);
                pdf_solid_angle = pdf_solid_angle_cone(source);
            }
            light.pdf_rev_area_across = pdf_solid_angle * inverse_distance2;
        }
    }
    return !is_black(light.alpha);
}

} // namespace fast
