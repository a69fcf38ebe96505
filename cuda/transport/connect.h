#pragma once

// The four families of strategies that join s vertices of a light walk and t vertices of an eye walk
// into a path. Each contribution goes to a sink with its strategy (s, t), its value (radiance, W m^-2
// sr^-1) as if that strategy were the only one, and its weight (mis_weight.h).
//
//   strategy                            the path is found by
//   emission_hit      s = 0,  t >= 2    the eye walk that hits a light source
//   next_event        s = 1,  t >= 2    an eye vertex and a fresh point of an emitter
//   light_image       s >= 1, t = 1     a light vertex seen from the eye; goes to any pixel
//   inner_connection  s >= 2, t >= 2    an eye vertex and a light vertex

#include "cuda/transport/emitter.h"
#include "cuda/transport/light_vertex.h"
#include "cuda/transport/subpath.h"

namespace fast {

/// An eye vertex z_{t-1} that can be joined: on a Lambertian surface.
template <class F>
struct EyeVertexOf {
    int t;
    SurfacePointOf<F> point;
    Vec3Of<F> facing;
    Vec3Of<F> alpha; // BSDF included
    F pdf_projected; // as in LightVertex
    F pdf_area;      // as in LightVertex
    F brackets[5];   // WalkVertex::bracket for s = 1, 2, 3, 4, and 5 or more; path tracing needs none

    /// B of docs/cuda-bdpt.md, equation (4), for a join to a light walk of s >= 1 vertices.
    /// (Chosen by comparisons, since a GPU has no registers that are numbered at run time.)
    [[nodiscard]] HD F bracket(int s) const
    {
        F found = brackets[4];
        for (int i = 0; i < 4; ++i)
            if (s == i + 1) found = brackets[i];
        return found;
    }
};
using EyeVertex = EyeVertexOf<float>;

/// A contribution that counts unless its ray is occluded.
template <class F>
struct CandidateOf {
    RayOf<F> ray;
    Vec3Of<F> value;
    F weight;
};

/// Whether no surface lies between two points that have been moved off their surfaces.
template <Needs needs>
HD bool visible(const SceneView<needs>& scene, const Vec3& from, const Vec3& to)
{
    return !occluded(scene.geometry, {from, 1.0f, to - from});
}

/// The same, with one ray from each point. The end of a segment may lie beyond another surface that is
/// close to its own surface; the start of a ray does not (clearance.h). Each ray continues past the
/// middle, since a surface at its end does not stop it. `position`: a point on the surface that `a`
/// has left. `d`: the vector from there to the corresponding point of b.
template <Needs needs>
SELDOM HD bool visible_from_both(const SceneView<needs>& scene, Vec3 a, Vec3 b, Vec3 position, Vec3 d)
{
    return visible(scene, a, position + 0.75f * d) && visible(scene, b, position + 0.25f * d);
}

/// s = 0: z_{t-1} of the eye walk is on `emitter`, on the side that emits. `pdf_fwd`: the density of
/// z_{t-1} in the eye walk, per area or, for the environment, per solid angle. `pdf_rev_direction`:
/// pdf_direction of `emitter` (emitter.h) towards z_{t-2}. `alpha`, `previous_joinable` and `sums` are
/// those of the walk at z_{t-1}.
template <Needs needs, Integrator integrator, class F>
HD F weight_of_emission_hit(const PathOptions& options, const EmitterOf<F>& emitter, int t,
                            const F& pdf_fwd, const F& pdf_rev_direction,
                            const MaskOf<F>& previous_joinable, const RunningSumsOf<F>& sums)
{
    // In a light walk z_{t-1} would be y_0.
    const F pdf_position = pdf_emission_position<needs>(emitter);
    if constexpr (integrator == Integrator::path) {
        return path_emission_hit_weight(previous_joinable && MaskOf<F>(t > 2), pdf_fwd, pdf_position);
    } else {
        const F bracket =
            sums.bracket(previous_joinable, pdf_rev_direction, F(1.0f), 0, options.heuristic);
        return emission_hit_weight(options.heuristic, SubpathEndOf<F>{pdf_fwd, pdf_position, bracket});
    }
}

/// The same, sent to `sink`.
template <Needs needs, Integrator integrator, class Sink>
HD void emission_hit(const PathOptions& options, const Emitter& emitter, int t, const Rgb& alpha,
                     float pdf_fwd, float pdf_rev_direction, bool previous_joinable,
                     const RunningSums& sums, Sink& sink)
{
    sink.add(0, t, alpha * emitter.emitted, // map: emission-hit
             weight_of_emission_hit<needs, integrator, float>(
                 options, emitter, t, pdf_fwd, pdf_rev_direction, previous_joinable, sums));
}

/// s = 1: z_{t-1} is joined to a fresh point of an emitter, drawn by `u`. Sets `candidate`, and returns
/// where there is one.
template <Needs needs, Integrator integrator, class F>
HD MaskOf<F> next_event_candidate(const SceneView<needs>& scene, const PathOptions& options,
                                  const UniformsOf<F>& u, const EyeVertexOf<F>& z, MaskOf<F> active,
                                  CandidateOf<F>& candidate)
{
    const IncidentLightOf<F> light = sample_incident(scene, z.point.position, u, active);
    const F cosine = glm::dot(z.facing, light.wi);
    candidate.value = z.alpha * cosine * light.alpha; // map: next-event
    active = active && cosine > 0.0f && !is_black(candidate.value);
    if (none(active)) return active;
    const EmitterOf<F>& emitter = at(scene.emitters, light.emitter);
    const MaskOf<F> surface = is_surface<needs>(emitter);
    active = active && (!surface || sees_first(scene, light.end, -light.wi, active && surface));
    candidate.ray.origin = leave_to_side(z.point, z.facing);
    candidate.ray.t_max = 1.0f;
    candidate.ray.direction = light.target - candidate.ray.origin;
    if constexpr (needs.other_lights) {
        const MaskOf<F> infinite = at_infinity<needs>(emitter);
        candidate.ray.t_max =
            select(infinite, F(std::numeric_limits<float>::infinity()), candidate.ray.t_max);
        candidate.ray.direction = select(infinite, light.wi, candidate.ray.direction);
        if (!scene.contact_triangles.empty())
            one_by_one(active && !surface, [&](auto lane) {
                const EndContacts& contacts = scene.lights[lane_of(light.emitter, lane)].contacts;
                if (lies_on<float>(scene, contacts, lane_of(z.point.primitive, lane)))
                    put_lane(active, lane, false);
            });
    }
    // The density of y_0 for the eye walk, in the measure of pdf_position.
    const F pdf_rev =
        select(can_be_hit<needs>(emitter), z.pdf_projected * cosine * light.geometry, F(0.0f));
    if constexpr (integrator == Integrator::path)
        candidate.weight = path_next_event_weight(pdf_rev, light.pdf_position);
    else
        candidate.weight =
            next_event_weight(options.heuristic, light.pdf_position, pdf_rev,
                              {z.pdf_area, light.pdf_rev_area_across * cosine, z.bracket(1)});
    return active;
}

/// s = 1, with the test of its ray.
template <Needs needs, Integrator integrator, class Sink>
HD void next_event(const SceneView<needs>& scene, const PathOptions& options, const SampleId& id,
                   const EyeVertex& z, Sink& sink)
{
    CandidateOf<float> candidate;
    const Uniforms u = uniforms(id, Event::next_event, static_cast<std::uint32_t>(z.t - 1));
    if (next_event_candidate<needs, integrator, float>(scene, options, u, z, true, candidate) &&
        !occluded(scene.geometry, candidate.ray))
        sink.add(1, z.t, candidate.value, candidate.weight);
}

/// t = 1: y_{s-1}, at `point`, is joined to the pinhole. `facing`: its normal on the side that sends
/// light. `alpha`: its weight times its emission or BSDF towards the eye, without the cosine.
/// `pdf_area`, `bracket`: of y_{s-1}, as in SubpathEnd. Sets `candidate` and its `pixel`, and returns
/// where there is one.
template <Needs needs, Integrator integrator, class F>
HD MaskOf<F> light_image_candidate(const SceneView<needs>& scene, const PathOptions& options, int s,
                                   const SurfacePointOf<F>& point, const Vec3Of<F>& facing,
                                   const F& pdf_area, const F& bracket, const Vec3Of<F>& alpha,
                                   MaskOf<F> active, CandidateOf<F>& candidate, WordOf<F>& pixel)
{
    const Vec3Of<F> d = Vec3Of<F>(scene.camera.eye) - point.position;
    const F distance2 = glm::dot(d, d);
    const F inverse_distance2 = 1.0f / distance2;
    const Vec3Of<F> w = d * square_root(inverse_distance2); // from the surface to the eye
    const F cosine = glm::dot(facing, w);
    active = active && cosine > 0.0f && !is_black(alpha) && scene.camera.project(-w, pixel);
    if (none(active)) return active;
    active = active && !lies_on<F>(scene, scene.eye_contacts, point.primitive);
    if (s == 1) active = active && sees_first(scene, point, w, active);
    candidate.ray.origin = leave_to_side(point, facing);
    candidate.ray.t_max = 1.0f;
    candidate.ray.direction = leave_end<needs, F>(scene, scene.camera.eye, scene.eye_contacts, -w,
                                                  distance2 * square_root(inverse_distance2)) -
                              candidate.ray.origin;
    // The density of y_{s-1} in the eye walk. It is also the measurement, since W_e cos is that
    // density.
    const F pdf_rev_area =
        to_area(scene.camera.pdf_solid_angle(scene.camera.cosine(-w)), cosine, inverse_distance2);
    candidate.value = alpha * pdf_rev_area; // map: light-image, importance
    candidate.weight =
        integrator == Integrator::light
            ? F(1.0f)
            : light_image_weight(options.heuristic, SubpathEndOf<F>{pdf_area, pdf_rev_area, bracket});
    return active;
}

/// The same with s = t = 1 for the environment: its y_0 is the direction `towards`, which was sampled
/// with density `pdf_solid_angle`. `alpha`: radiance over that density.
template <Needs needs, Integrator integrator>
HD bool light_image_of_infinity(const SceneView<needs>& scene, const PathOptions& options,
                                const Vec3& towards, float pdf_solid_angle, const Rgb& alpha,
                                CandidateOf<float>& candidate, std::uint32_t& pixel)
{
    if (!scene.camera.project(towards, pixel)) return false;
    candidate.ray = {leave_end(scene, scene.camera.eye, scene.eye_contacts, towards),
                     std::numeric_limits<float>::infinity(), towards};
    const float pdf_rev_solid_angle = scene.camera.pdf_solid_angle(scene.camera.cosine(towards));
    candidate.value = alpha * pdf_rev_solid_angle;
    candidate.weight = integrator == Integrator::light
                           ? 1.0f
                           : light_image_weight(options.heuristic,
                                                SubpathEnd{pdf_solid_angle, pdf_rev_solid_angle, 1.0f});
    return true;
}

/// s >= 2: z_{t-1} is joined to y_{s-1}. Sets `candidate`, and returns where there is one.
template <Needs needs, class F>
HD MaskOf<F> inner_connection_candidate(const SceneView<needs>& scene, const PathOptions& options, int s,
                                        const LightVertexOf<F>& y, const EyeVertexOf<F>& z,
                                        MaskOf<F> active, CandidateOf<F>& candidate)
{
    active = active && !is_black(y.alpha); // else no other member of y was ever written
    const Vec3Of<F> d = y.position - z.point.position;
    const F distance2 = glm::dot(d, d);
    const F inverse_distance2 = 1.0f / distance2;
    const F to_unit = square_root(inverse_distance2);
    const F cosine_z = glm::dot(z.facing, d) * to_unit;
    const F cosine_y = -glm::dot(y.facing, d) * to_unit;
    active = active && cosine_z > 0.0f && cosine_y > 0.0f;
    // map: geometric-term [Veach 1997, sec. 8.1]
    const F geometry = cosine_z * cosine_y * inverse_distance2; // G
    candidate.value = z.alpha * geometry * y.alpha;             // map: inner-connection
    active = active && !is_black(candidate.value);
    if (none(active)) return active;
    const F clearance = y.clearance + clearance_per_length * distance2 * to_unit;
    candidate.ray.origin = leave_to_side(z.point, z.facing);
    candidate.ray.t_max = 1.0f;
    candidate.ray.direction = y.position + clearance * y.facing - candidate.ray.origin;
    if constexpr (needs.coincident)
        one_by_one(active && y.clearance < 0.0f, [&](auto lane) {
            const LightVertex near = lane_of(y, lane);
            if (!visible_from_both(scene, lane_of(candidate.ray.origin, lane),
                                   near.position - near.clearance * near.facing,
                                   lane_of(z.point.position, lane), lane_of(d, lane)))
                put_lane(active, lane, false);
            put_lane(candidate.ray.direction, lane, Vec3(0.0f)); // not a ray: it is never occluded
        });
    // Converts a density per projected solid angle at one end to one per area at the other: both
    // cosines, over the squared distance.
    const F pdf_rev_area_y = z.pdf_projected * geometry;
    const F pdf_rev_area_z = y.pdf_projected * geometry;
    candidate.weight = inner_connection_weight(
        options.heuristic, SubpathEndOf<F>{y.pdf_area, pdf_rev_area_y, y.bracket(z.t)},
        SubpathEndOf<F>{z.pdf_area, pdf_rev_area_z, z.bracket(s)});
    return active;
}

/// The same, with the test of its ray.
template <Needs needs, class Sink>
HD void inner_connection(const SceneView<needs>& scene, const PathOptions& options, int s,
                         const LightVertex& y, const EyeVertex& z, Sink& sink)
{
    CandidateOf<float> candidate;
    if (inner_connection_candidate<needs, float>(scene, options, s, y, z, true, candidate) &&
        !occluded(scene.geometry, candidate.ray))
        sink.add(s, z.t, candidate.value, candidate.weight);
}

} // namespace fast
