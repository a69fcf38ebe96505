#pragma once

// Choosing an emitter, and drawing light for a point (next event). The start of light walks is in
// emission.h; how one kind of emitter differs from another, in emitter_kinds.h. Densities are those of
// the reference. The measure of two of them depends on the emitter:
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

/// The number of the emitter that `u` in [0, 1) falls on: the first whose sum exceeds u. An emitter
/// without power is never chosen. At least one emitter must have power.
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

/// pdf_position: the density with which the emitter and its y_0 are drawn. 0 for a surface of no area.
template <Needs needs>
HD float pdf_emission_position(const Emitter& emitter)
{
    if (is_surface<needs>(emitter))
        return emitter.area > 0.0f ? emitter.probability / emitter.area : 0.0f;
    return at_infinity<needs>(emitter) ? emitter.probability * pdf_towards(emitter)
                                       : emitter.probability;
}

/// The density, per area of the disc, of the start of a walk from infinity. The start is a uniform point
/// of a disc that covers the scene.
template <Needs needs>
HD float pdf_area_disc(const SceneView<needs>& scene)
{
    return inverse_pi / (scene.radius * scene.radius);
}

/// Light that may reach a point `from`, with the densities that the weights need.
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

/// Draws light for `from` by the first three numbers of `u`. False if no light comes from the point
/// drawn.
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
        if (at_infinity<needs>(emitter)) {
            light.wi = sample_towards(emitter, source, u[1], u[2]);
            light.pdf_rev_area_across = pdf_area_disc(scene);
        } else {
            const Vec3 d = source.position - from;
            const float distance2 = glm::dot(d, d);
            const float inverse_distance2 = 1.0f / distance2;
            light.wi = d * std::sqrt(inverse_distance2);
            light.target = leave_end(scene, source.position, source.contacts, -d,
                                     distance2 * std::sqrt(inverse_distance2));
            SourceDirection direction{};
            if (!source_direction(emitter, source, -light.wi, direction)) return false;
            light.alpha *= inverse_distance2;
            light.alpha *= direction.falloff;
            light.pdf_rev_area_across = direction.pdf_solid_angle * inverse_distance2;
        }
    }
    return !is_black(light.alpha);
}

} // namespace fast
