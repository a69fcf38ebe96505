#pragma once

// The eye walk: each of its vertices may be on an emitter, and is joined to a fresh point of an
// emitter and to the stored vertices of the light walk.

#include "cuda/transport/connect.h"
#include "cuda/transport/watch.h"

namespace fast {

/// The ray from the eye through a random point of the pixel of `id`.
template <Needs needs, class F>
HD LegOf<F> camera_leg(const SceneView<needs>& scene, const SampleIdOf<F>& id)
{
    const UniformsOf<F> u = uniforms(id, Event::camera);
    WordOf<F> column;
    const WordOf<F> row = divided(id.pixel, scene.camera.width, column);
    // map: film-position
    const Vec3Of<F> direction = scene.camera.direction(to_float(column) + u[0], to_float(row) + u[1]);
    return {{leave_end<needs, F>(scene, scene.camera.eye, scene.eye_contacts, direction),
             F(std::numeric_limits<float>::infinity()), direction},
            Vec3Of<F>(scene.camera.eye),
            false,
            scene.camera.pdf_solid_angle(scene.camera.cosine(direction)), // map: density-z1
            F(0.0f)};
}

/// The data that connections need of `v`, which is on a Lambertian surface. Path tracing needs no
/// brackets.
template <Integrator integrator, class F>
HD EyeVertexOf<F> eye_vertex(Heuristic heuristic, const WalkVertexOf<F>& v)
{
    EyeVertexOf<F> z{v.n + 1,
                     v.point,
                     v.facing,
                     v.alpha * v.material.color * F(inverse_pi), // map: bsdf-lambertian
                     chance_of(v.material, v.n) * inverse_pi,
                     v.pdf_area,
                     {}};
    if constexpr (integrator != Integrator::path)
        for (int s = 1; s <= 5; ++s) z.brackets[s - 1] = v.bracket(s, heuristic);
    return z;
}

/// Walks from the eye and makes all connections of every vertex: `kept` holds `count` vertices of the
/// light walk.
template <Needs needs, Integrator integrator, class Sink>
HD void eye_subpath(const SceneView<needs>& scene, const PathOptions& options, const SampleId& id,
                    const LightVertices& kept, int count, Sink& sink)
{
    walk(
        scene, options, id, Transport::radiance, camera_leg(scene, id), false, Rgb(1.0f),
        options.max_edges + 1,
        [&](const WalkVertex& v) {
            show_vertex(sink, Transport::radiance, v);
            // map: emitted-radiance
            if (v.emitter != no_emitter && glm::dot(v.point.normal, v.wo) > 0.0f)
                emission_hit<needs, integrator>(options, scene.emitters[v.emitter], v.n + 1, v.alpha,
                                                v.pdf_area, v.pdf_rev_solid_angle(), v.previous_joinable,
                                                v.sums, sink);
            if (!scatters(v.material) || v.n == options.max_edges || scene.cumulative.empty()) return;
            const EyeVertex z = eye_vertex<integrator, float>(options.heuristic, v);
            next_event<needs, integrator>(scene, options, id, z, sink);
            if constexpr (integrator != Integrator::path)
                for (int s = 2; s <= count + 1 && s + v.n <= options.max_edges; ++s)
                    inner_connection(scene, options, s, kept[s - 2], z, sink);
        },
        [&](const Leg& last, int n, const Rgb& alpha, bool previous_joinable, const RunningSums& sums) {
            show_miss(sink, Transport::radiance, last);
            if (needs.other_lights && scene.has_environment)
                emission_hit<needs, integrator>(options, scene.emitters.back(), n + 1, alpha,
                                                last.pdf_direction, pdf_area_disc(scene),
                                                previous_joinable, sums, sink);
        });
}

} // namespace fast
