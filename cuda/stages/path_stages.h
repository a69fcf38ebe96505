#pragma once

// Path tracing in stages [Laine, Karras, Aila 2013]: every stage does one step for all unfinished paths,
// and hands them on in queues. A stage is a function object of one index, like every kernel
// (cuda/parallel/executor.h), but of a number type F (number.h): the same code is for one path or for
// many.
//
//   generate       the ray of each sample through its pixel
//   extend         the closest hit of each ray
//   shade          emission where the path has come to, a candidate of next event estimation, the bounce
//   test_shadow    adds the candidates whose ray is not occluded
//
// The last three repeat for every vertex of the paths; trace_paths.h is that loop. Each sample gets the
// same bits as from eye_subpath.h: the contributions of a sample are added in the same order.

#include "cuda/stages/stage_job.h"

namespace fast {

/// An unfinished path, and its ray to the next vertex.
template <class F>
struct PathStateOf {
    Vec3Of<F> origin; // of the ray
    Vec3Of<F> direction;
    Vec3Of<F> from; // the vertex that the ray leaves
    F pdf_direction;
    Vec3Of<F> alpha;
    WordOf<F> joinable; // whether the vertex that the ray leaves scatters: 1 or 0
    WordOf<F> slot;     // the index of the sample in the launch
};

/// Over the samples of a block of a launch.
template <Needs needs>
struct Generate {
    static constexpr int least_blocks = stage_blocks;
    StageJob<needs> job;
    std::uint32_t first_slot;
    Rows<PathStateOf> paths;

    template <class Index>
    HD void operator()(const Index& index) const
    {
        using F = NumberTypeAt<Index>;
        const WordOf<F> slot = index_of(index) + first_slot;
        const LegOf<F> leg = camera_leg(job.scene, job.template id_of<F>(slot));
        store(paths, index,
              PathStateOf<F>{leg.ray.origin, leg.ray.direction, leg.from, leg.pdf_direction,
                             Vec3Of<F>(1.0f), WordOf<F>(1u), slot});
    }
};

/// Over unfinished paths, at their vertex n.
template <Needs needs, Part part>
struct Shade {
    static constexpr int least_blocks = stage_blocks;
    StageJob<needs> job;
    int n;
    Rows<PathStateOf> paths;
    Rows<HitOf> hits;
    Queue<PathStateOf> next;
    Queue<WaitingOf> waiting;

    template <class Index>
    HD void operator()(const Index& index) const
    {
        using F = NumberTypeAt<Index>;
        const SceneView<needs>& scene = job.scene;
        const PathStateOf<F> path = load(paths, index);
        HitOf<F> hit = load(hits, index);
        MaskOf<F> active = active_at(index) && hit.primitive != WordOf<F>(no_primitive);
        const MaskOf<F> joinable = path.joinable != WordOf<F>(0u);
        if constexpr (needs.other_lights && includes(part, Part::bounce))
            if (scene.has_environment)
                add_emission(active_at(index) && !active, path, joinable, path.pdf_direction,
                             EmitterOf<F>(at(scene.emitters, last_emitter<F>())));
        if (none(active)) return;
        hit.primitive = select(active, hit.primitive, WordOf<F>(0u)); // any that exists

        LegOf<F> leg{{path.origin, F(std::numeric_limits<float>::infinity()), path.direction},
                     path.from,
                     false,
                     path.pdf_direction,
                     F(0.0f)};
        const MetSurfaceOf<F> met = meet_surface<needs, F>(scene, leg, hit, active);
        active = active && met.pdf_area > 0.0f; // else in the plane of the surface: the density is 0
        if constexpr (includes(part, Part::bounce)) {
            const MaskOf<F> emits = active && met.emitter != WordOf<F>(no_emitter) &&
                                    glm::dot(met.point.normal, met.wo) > 0.0f;
            if (any(emits))
                add_emission(
                    emits, path, joinable, met.pdf_area,
                    EmitterOf<F>(at(scene.emitters, select(emits, met.emitter, WordOf<F>(0u)))));
        }
        if (n == job.options.max_edges) return;

        const SampleIdOf<F> id = job.template id_of<F>(path.slot);
        if constexpr (includes(part, Part::joins))
            if (!scene.cumulative.empty()) next_event(active && scatters(met.material), id, path, met);
        if constexpr (!includes(part, Part::bounce)) return;

        const UniformsOf<F> u = uniforms(id, Event::eye_bounce, static_cast<std::uint32_t>(n));
        Vec3Of<F> alpha = path.alpha;
        F pdf_rev;
        const MaskOf<F> goes_on = bounce<needs, F>(met, n, u, Transport::radiance, leg, alpha, pdf_rev);
        push(next, active && goes_on && !is_black(alpha),
             PathStateOf<F>{leg.ray.origin, leg.ray.direction, leg.from, leg.pdf_direction, alpha,
                            select(scatters(met.material), WordOf<F>(1u), WordOf<F>(0u)), path.slot});
    }

private:
    template <class F>
    [[nodiscard]] HD WordOf<F> last_emitter() const
    {
        return static_cast<std::uint32_t>(job.scene.emitters.size()) - 1;
    }

    /// s = 0, where `mask`.
    template <class F>
    HD void add_emission(const MaskOf<F>& mask, const PathStateOf<F>& path, const MaskOf<F>& joinable,
                         const F& pdf_fwd, const EmitterOf<F>& emitter) const
    {
        const F weight = path_emission_hit_weight(joinable && MaskOf<F>(n > 1), pdf_fwd,
                                                  pdf_emission_position<needs>(emitter));
        job.add(mask, path.slot, 0, n + 1, path.alpha * emitter.emitted, weight);
    }

    /// s = 1, where `mask`.
    template <class F>
    HD void next_event(const MaskOf<F>& mask, const SampleIdOf<F>& id, const PathStateOf<F>& path,
                       const MetSurfaceOf<F>& met) const
    {
        if (none(mask)) return;
        const EyeVertexOf<F> z{n + 1,
                               met.point,
                               met.facing,
                               path.alpha * met.material.color * F(inverse_pi),
                               chance_of(met.material, n) * inverse_pi,
                               met.pdf_area,
                               {}};
        const UniformsOf<F> u = uniforms(id, Event::next_event, static_cast<std::uint32_t>(n));
        WaitingOf<F> result{{}, path.slot};
        push(waiting,
             next_event_candidate<needs, Integrator::path, F>(job.scene, job.options, u, z, mask,
                                                              result.candidate),
             result);
    }
};

} // namespace fast
