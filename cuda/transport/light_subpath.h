#pragma once

// The light walk: each of its vertices is joined to the eye at once, and stored for the eye walk.

#include "cuda/transport/connect.h"
#include "cuda/transport/watch.h"

namespace fast {

/// The light image of y_0, s = t = 1, if the eye sees the emitter.
template <Needs needs, Integrator integrator, class Sink>
HD void light_image_of_emitter(const SceneView<needs>& scene, const PathOptions& options,
                               const SampledEmission& emission, Sink& sink)
{
    const Emitter& emitter = scene.emitters[emission.emitter];
    if (!can_be_hit<needs>(emitter)) return;
    const float pdf_position = pdf_emission_position<needs>(emitter);
    const Rgb alpha = emitter.emitted / pdf_position;
    if (at_infinity<needs>(emitter))
        light_image_of_infinity<needs, integrator>(scene, options, emission.towards, pdf_position, alpha,
                                                   sink);
    else
        light_image<needs, integrator>(scene, options, 1, emission.end, emission.end.normal,
                                       pdf_position, 1.0f, alpha, sink);
}

/// The first leg, from y_0 to y_1.
template <Needs needs>
HD Leg first_leg(const SceneView<needs>& scene, const SampledEmission& emission)
{
    const Emitter& emitter = scene.emitters[emission.emitter];
    // The emission of a surface has density cosine / pi; at infinity there is no cosine.
    const float cosine = is_surface<needs>(emitter) ? emission.pdf_direction * pi : 1.0f;
    return {emission.ray, emission.end.position, at_infinity<needs>(emitter), emission.pdf_direction,
            can_be_hit<needs>(emitter) ? cosine / pdf_emission_position<needs>(emitter) : 0.0f};
}

/// The data of `y`, which is on a Lambertian surface, that are stored. `alpha`: its weight, BSDF
/// included.
template <Needs needs>
HD LightVertex light_vertex(const SceneView<needs>& scene, Heuristic heuristic, const WalkVertex& y,
                            const Rgb& alpha)
{
    const std::uint32_t contacts = scene.surfaces[y.point.primitive].contacts;
    const bool is_near = scene.surface_contacts[contacts].near_count > 0;
    return {y.point.position,
            is_near ? -y.point.clearance : y.point.clearance,
            y.facing,
            chance_of(y.material, y.n) * inverse_pi,
            alpha,
            y.pdf_area,
            {y.bracket(2, heuristic), y.bracket(3, heuristic), y.bracket(4, heuristic),
             y.bracket(5, heuristic)}};
}

/// Walks from an emitter: sends the light image to `sink`, and stores in `kept` the vertices to which
/// eye vertices can be joined. Returns the number of entries stored: y_1, y_2, ...
template <Needs needs, Integrator integrator, class Sink>
HD int light_subpath(const SceneView<needs>& scene, const PathOptions& options, const SampleId& id,
                     const LightVertices& kept, Sink& sink)
{
    constexpr bool keep = integrator == Integrator::bdpt;
    if (scene.cumulative.empty()) return 0;
    const SampledEmission emission = sample_emission(scene, uniforms(id, Event::emission_position),
                                                     uniforms(id, Event::emission_direction));
    show_emission(sink, emission);
    light_image_of_emitter<needs, integrator>(scene, options, emission, sink);
    const bool hittable = can_be_hit<needs>(scene.emitters[emission.emitter]);
    const int most_vertices = keep ? glm::min(options.max_edges, kept.capacity + 1) : options.max_edges;
    int count = 0;
    walk(
        scene, options, id, Transport::power, first_leg(scene, emission), hittable, emission.alpha,
        most_vertices,
        [&](const WalkVertex& y) {
            show_vertex(sink, Transport::power, y);
            if constexpr (keep) ++count;
            if (!scatters(y.material)) {
                if constexpr (keep) kept[y.n - 1].alpha = Rgb(0.0f);
                return;
            }
            const Rgb alpha = y.alpha * y.material.color * inverse_pi;
            light_image<needs, integrator>(scene, options, y.n + 1, y.point, y.facing, y.pdf_area,
                                           y.bracket(1, options.heuristic), alpha, sink);
            if constexpr (keep) kept[y.n - 1] = light_vertex(scene, options.heuristic, y, alpha);
        },
        [&](const Leg& last, int, const Rgb&, bool, const RunningSums&) {
            show_miss(sink, Transport::power, last);
        });
    return count;
}

} // namespace fast
