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
template <Needs needs, class F>
HD WordOf<F> choose_emitter(const SceneView<needs>& scene, const F& u)
{
    WordOf<F> first = 0u;
    WordOf<F> last = static_cast<std::uint32_t>(scene.cumulative.size()) - 1;
    // The range of every index is halved, and ends with one element.
    for (std::size_t range = scene.cumulative.size(); range > 1; range -= range / 2) {
        const WordOf<F> middle = halved(first + last);
        const MaskOf<F> below = at(scene.cumulative, middle) > u;
        last = select(below, middle, last);
        first = select(below || first == last, first, middle + 1u);
    }
    return first;
}

/// A uniform point on an emitter that is a surface. Where not `active`, any point.
template <Needs needs, class F>
HD SurfacePointOf<F> sample_surface(const SceneView<needs>& scene, const EmitterOf<F>& emitter,
                                    const F& u1, const F& u2, const MaskOf<F>& active)
{
    SurfacePointOf<F> point{};
    const MaskOf<F> triangle = active && emitter.kind == EmitterKind::triangle;
    if (any(triangle)) {
        F b1 = 0.0f;
        F b2 = 0.0f;
        sample_triangle(u1, u2, b1, b2);
        point = triangle_point<needs, F>(scene, select(triangle, emitter.index, WordOf<F>(0u)), b1, b2);
    }
    if constexpr (needs.spheres && needs.other_lights) {
        const MaskOf<F> sphere = active && emitter.kind == EmitterKind::sphere;
        const auto triangles = static_cast<std::uint32_t>(scene.triangles.size());
        if (any(sphere))
            point =
                select(sphere,
                       // map: emission-sphere
                       sphere_point<needs, F>(scene, select(sphere, emitter.index, WordOf<F>(triangles)),
                                              sample_sphere(u1, u2)),
                       point);
    }
    return point;
}

/// pdf_position: the density with which the emitter and its y_0 are drawn. 0 for a surface of no area.
template <Needs needs, class F>
HD F pdf_emission_position(const EmitterOf<F>& emitter)
{
    // map: density-y0
    const F per_area = select(emitter.area > 0.0f, emitter.probability / emitter.area, F(0.0f));
    if constexpr (!needs.other_lights) return per_area;
    return select(is_surface<needs>(emitter), per_area,
                  select(at_infinity<needs>(emitter), emitter.probability * pdf_towards(emitter),
                         emitter.probability));
}

/// The density, per area of the disc, of the start of a walk from infinity. The start is a uniform point
/// of a disc that covers the scene.
template <Needs needs>
HD float pdf_area_disc(const SceneView<needs>& scene)
{
    return inverse_pi / (scene.radius * scene.radius); // map: density-y1
}

/// Light that may reach a point `from`, with the densities that the weights need.
template <class F>
struct IncidentLightOf {
    WordOf<F> emitter;
    Vec3Of<F> wi;    // unit, from the point towards the light
    Vec3Of<F> alpha; // emitted towards the point, cosine at the light over squared distance
                     // included, over pdf_position; black: no light comes from the point drawn
    F geometry;      // turns a density per solid angle at `from` into one at y_0: the cosine at the
                     // light over squared distance [Veach 1997, eq. 8.10]; 1 at infinity
    F pdf_position;  // of y_0
    F pdf_rev_area_across; // with which a light walk at y_0 comes to `from`: per area across wi, so
                           // that times the cosine at `from` it is per area of the surface there
    SurfacePointOf<F> end; // y_0, if it is on a surface
    Vec3Of<F> target;      // where the segment to be tested ends, unless at infinity
};
using IncidentLight = IncidentLightOf<float>;

/// Sets the members of `light` for a point of a surface, drawn by u1 and u2.
template <Needs needs, class F>
HD void light_of_surface(const SceneView<needs>& scene, const Vec3Of<F>& from,
                         const EmitterOf<F>& emitter, const F& u1, const F& u2, const MaskOf<F>& active,
                         IncidentLightOf<F>& light)
{
    light.end = sample_surface(scene, emitter, u1, u2, active);
    const Vec3Of<F> d = light.end.position - from;
    const F distance2 = glm::dot(d, d);
    const F inverse_distance2 = 1.0f / distance2;
    light.wi = d * square_root(inverse_distance2);
    const F cosine = -glm::dot(light.end.normal, light.wi);
    light.geometry = cosine * inverse_distance2;
    light.pdf_rev_area_across = cosine * inverse_pi * inverse_distance2;
    light.alpha = select(cosine > 0.0f && light.pdf_position > 0.0f, // else the dark side
                         emitter.emitted * (light.geometry / light.pdf_position), Vec3Of<F>(0.0f));
    light.target =
        end_at_surface(light.end, light.end.normal, distance2 * square_root(inverse_distance2));
}

/// The same for an emitter that is not a surface.
template <Needs needs>
HD void light_of_others(const SceneView<needs>& scene, const Vec3& from, const Emitter& emitter,
                        float u1, float u2, IncidentLight& light)
{
    const Light& source = scene.lights[light.emitter];
    light.geometry = 1.0f;
    light.alpha = emitter.emitted / light.pdf_position;
    if (at_infinity<needs>(emitter)) {
        light.wi = sample_towards(emitter, source, u1, u2);
        light.pdf_rev_area_across = pdf_area_disc(scene);
        return;
    }
    const Vec3 d = source.position - from;
    const float distance2 = glm::dot(d, d);
    const float inverse_distance2 = 1.0f / distance2;
    light.wi = d * std::sqrt(inverse_distance2);
    light.target =
        leave_end(scene, source.position, source.contacts, -d, distance2 * std::sqrt(inverse_distance2));
    SourceDirection direction{};
    if (!source_direction(emitter, source, -light.wi, direction)) {
        light.alpha = Rgb(0.0f);
        return;
    }
    light.alpha *= inverse_distance2;
    light.alpha *= direction.falloff;
    light.pdf_rev_area_across = direction.pdf_solid_angle * inverse_distance2;
}

/// Draws light for `from` by the first three numbers of `u`, where `active`.
template <Needs needs, class F>
HD IncidentLightOf<F> sample_incident(const SceneView<needs>& scene, const Vec3Of<F>& from,
                                      const UniformsOf<F>& u, const MaskOf<F>& active)
{
    IncidentLightOf<F> light{};
    light.emitter = choose_emitter(scene, u[0]);
    const EmitterOf<F>& emitter = at(scene.emitters, light.emitter);
    light.pdf_position = pdf_emission_position<needs>(emitter);
    const MaskOf<F> surface = active && is_surface<needs>(emitter);
    if (any(surface)) light_of_surface(scene, from, emitter, u[1], u[2], surface, light);
    if constexpr (needs.other_lights)
        one_by_one(active && !surface, [&](auto lane) {
            IncidentLight one = lane_of(light, lane);
            light_of_others(scene, lane_of(from, lane), lane_of(emitter, lane), lane_of(u[1], lane),
                            lane_of(u[2], lane), one);
            put_lane(light, lane, one);
        });
    return light;
}

} // namespace fast
