#pragma once

// The light walk: each of its vertices is joined to the eye at once, and stored for the eye walk.

#include "cuda/transport/connect.h"
#include "cuda/transport/watch.h"

namespace fast {

/// The light image of y_0, s = t = 1, if the eye may see the emitter. Sets `candidate` and its `pixel`,
/// and returns where there is one.
template <Needs needs, Integrator integrator, class F>
HD MaskOf<F> image_of_emitter_candidate(const SceneView<needs>& scene, const PathOptions& options,
                                        const SampledEmissionOf<F>& emission, const MaskOf<F>& active,
                                        CandidateOf<F>& candidate, WordOf<F>& pixel)
{
    const EmitterOf<F>& emitter = at(scene.emitters, emission.emitter);
    const F pdf_position = pdf_emission_position<needs>(emitter);
    const Vec3Of<F> alpha = emitter.emitted / pdf_position;
    const MaskOf<F> surface = active && is_surface<needs>(emitter);
    MaskOf<F> found = false;
    if (any(surface))
        found = light_image_candidate<needs, integrator, F>(scene, options, 1, emission.end,
                                                            emission.end.normal, pdf_position, F(1.0f),
                                                            alpha, surface, candidate, pixel);
    if constexpr (needs.other_lights)
        one_by_one(active && !surface && can_be_hit<needs>(emitter), [&](auto lane) {
            CandidateOf<float> one{};
            std::uint32_t its_pixel = 0;
            if (!light_image_of_infinity<needs, integrator>(
                    scene, options, lane_of(emission.towards, lane), lane_of(pdf_position, lane),
                    lane_of(alpha, lane), one, its_pixel))
                return;
            put_lane(found, lane, true);
            put_lane(candidate, lane, one);
            put_lane(pixel, lane, its_pixel);
        });
    return found;
}

/// The first leg, from y_0 to y_1.
template <Needs needs, class F>
HD LegOf<F> first_leg(const SceneView<needs>& scene, const SampledEmissionOf<F>& emission)
{
    const EmitterOf<F>& emitter = at(scene.emitters, emission.emitter);
    // The emission of a surface has density cosine / pi; at infinity there is no cosine.
    const F cosine = select(is_surface<needs>(emitter), emission.pdf_direction * pi, F(1.0f));
    return {emission.ray, emission.end.position, at_infinity<needs>(emitter), emission.pdf_direction,
            select(can_be_hit<needs>(emitter), cosine / pdf_emission_position<needs>(emitter), F(0.0f))};
}

/// The data of `y`, which is on a Lambertian surface, that are stored. `alpha`: its weight, BSDF
/// included.
template <Needs needs, class F>
HD LightVertexOf<F> light_vertex(const SceneView<needs>& scene, Heuristic heuristic,
                                 const WalkVertexOf<F>& y, const Vec3Of<F>& alpha)
{
    F clearance = y.point.clearance;
    if (needs.coincident && !scene.coincident.empty())
        one_by_one(true_for_all<F>(), [&](auto lane) {
            const std::uint32_t contacts = scene.surfaces[lane_of(y.point.primitive, lane)].contacts;
            if (scene.surface_contacts[contacts].near_count > 0)
                put_lane(clearance, lane, -lane_of(clearance, lane));
        });
    return {y.point.position,
            clearance,
            y.facing,
            chance_of(y.material, y.n) * inverse_pi,
            alpha,
            y.pdf_area,
            {y.bracket(2, heuristic), y.bracket(3, heuristic), y.bracket(4, heuristic),
             y.bracket(5, heuristic)}};
}

/// Sends a candidate to `sink` as a splat, unless its ray is occluded.
template <Needs needs, class Sink>
HD void splat_if_visible(const SceneView<needs>& scene, int s, const CandidateOf<float>& candidate,
                         std::uint32_t pixel, Sink& sink)
{
    if (!occluded(scene.geometry, candidate.ray))
        sink.splat(pixel, s, candidate.value, candidate.weight);
}

/// Walks from an emitter: sends the light image to `sink`, and stores in `kept` the vertices to which
/// eye vertices can be joined. Returns the number of entries stored: y_1, y_2, ...
template <Needs needs, Integrator integrator, class Sink>
HD int light_subpath(const SceneView<needs>& scene, const PathOptions& options, const SampleId& id,
                     const LightVertices& kept, Sink& sink)
{
    constexpr bool keep = integrator == Integrator::bdpt;
    if (scene.cumulative.empty()) return 0;
    const SampledEmission emission = sample_emission<needs, float>(
        scene, uniforms(id, Event::emission_position), uniforms(id, Event::emission_direction), true);
    show_emission(sink, emission);
    CandidateOf<float> candidate{};
    std::uint32_t pixel = 0;
    if (image_of_emitter_candidate<needs, integrator, float>(scene, options, emission, true, candidate,
                                                             pixel))
        splat_if_visible(scene, 1, candidate, pixel, sink);
    const bool hittable = can_be_hit<needs>(scene.emitters[emission.emitter]);
    const int most_vertices = keep ? glm::min(options.max_edges, kept.capacity + 1) : options.max_edges;
    int count = 0;
    walk(
        scene, options, id, Transport::power, first_leg<needs, float>(scene, emission), hittable,
        emission.alpha, most_vertices,
        [&](const WalkVertex& y) {
            show_vertex(sink, Transport::power, y);
            if constexpr (keep) ++count;
            if (!scatters(y.material)) {
                if constexpr (keep) kept[y.n - 1].alpha = Rgb(0.0f);
                return;
            }
            const Rgb alpha = y.alpha * y.material.color * inverse_pi;
            if (light_image_candidate<needs, integrator, float>(
                    scene, options, y.n + 1, y.point, y.facing, y.pdf_area,
                    y.bracket(1, options.heuristic), alpha, true, candidate, pixel))
                splat_if_visible(scene, y.n + 1, candidate, pixel, sink);
            if constexpr (keep)
                kept[y.n - 1] = light_vertex<needs, float>(scene, options.heuristic, y, alpha);
        },
        [&](const Leg& last, int, const Rgb&, bool, const RunningSums&) {
            show_miss(sink, Transport::power, last);
        });
    return count;
}

} // namespace fast
