#pragma once

// The stages of eye walks, and of their connections to light walks (bdpt_stages.h).

#include "cuda/stages/walk_state.h"

namespace fast {

/// An eye vertex that waits for its connections.
template <class F>
struct StoredEyeVertexOf {
    Vec3Of<F> position;
    F clearance;
    Vec3Of<F> facing;
    Vec3Of<F> alpha;
    F pdf_projected, pdf_area;
    F brackets[5];
    WordOf<F> slot;
};

/// Over the samples of a block.
template <Needs needs>
struct GenerateEye {
    static constexpr int least_blocks = stage_blocks;
    StageJob<needs> job;
    std::uint32_t first_slot;
    Rows<WalkStateOf> walks;

    template <class Index>
    HD void operator()(const Index& index) const
    {
        using F = NumberTypeAt<Index>;
        WalkStateOf<F> walk{};
        walk.slot = index_of(index) + first_slot;
        walk.set_leg(camera_leg(job.scene, job.template id_of<F>(walk.slot)));
        walk.alpha = Vec3Of<F>(1.0f);
        walk.flags = WordOf<F>(WalkStateOf<F>::previous_joinable); // a pinhole cannot be hit
        walk.survival = F(1.0f);
        store(walks, index, walk);
    }
};

/// Over unfinished eye walks, at their vertex n.
template <Needs needs, Part part>
struct ShadeEye {
    static constexpr int least_blocks = stage_blocks;
    StageJob<needs> job;
    int n;
    Rows<WalkStateOf> walks;
    Rows<HitOf> hits;
    Queue<WalkStateOf> next;
    Queue<WaitingOf> waiting;
    Queue<StoredEyeVertexOf> vertices;

    template <class Index>
    HD void operator()(const Index& index) const
    {
        using F = NumberTypeAt<Index>;
        const SceneView<needs>& scene = job.scene;
        WalkStateOf<F> walk = load(walks, index);
        HitOf<F> hit = load(hits, index);
        MaskOf<F> active = active_at(index) && hit.primitive != WordOf<F>(no_primitive);
        if constexpr (needs.other_lights && includes(part, Part::bounce))
            if (scene.has_environment) add_environment(active_at(index) && !active, walk);
        if (none(active)) return;
        hit.primitive = select(active, hit.primitive, WordOf<F>(0u)); // any that exists
        MetSurfaceOf<F> met;
        const WalkVertexOf<F> v = walk_vertex(job, n, walk, hit, active, met);
        if constexpr (includes(part, Part::bounce)) {
            const MaskOf<F> emits =
                active && v.emitter != WordOf<F>(no_emitter) && glm::dot(v.point.normal, v.wo) > 0.0f;
            if (any(emits))
                add_emission(emits, walk,
                             EmitterOf<F>(at(scene.emitters, select(emits, v.emitter, WordOf<F>(0u)))),
                             v.pdf_area, v.pdf_rev_solid_angle(), v.previous_joinable, v.sums);
        }
        if (n == job.options.max_edges) return;
        const SampleIdOf<F> id = job.template id_of<F>(walk.slot);
        if constexpr (includes(part, Part::joins))
            if (!scene.cumulative.empty()) join(active && scatters(v.material), id, walk.slot, v);
        if constexpr (includes(part, Part::bounce))
            push(next, active && next_walk<needs, F>(v, met, id, Transport::radiance, walk), walk);
    }

private:
    /// s = 0, where `mask`.
    template <class F>
    HD void add_emission(const MaskOf<F>& mask, const WalkStateOf<F>& walk, const EmitterOf<F>& emitter,
                         const F& pdf_fwd, const F& pdf_rev, const MaskOf<F>& previous_joinable,
                         const RunningSumsOf<F>& sums) const
    {
        job.add(mask, walk.slot, 0, n + 1, walk.alpha * emitter.emitted,
                weight_of_emission_hit<needs, Integrator::bdpt, F>(job.options, emitter, n + 1, pdf_fwd,
                                                                   pdf_rev, previous_joinable, sums));
    }

    /// Where `mask`, the walk has left the scene.
    template <class F>
    HD void add_environment(const MaskOf<F>& mask, const WalkStateOf<F>& walk) const
    {
        if (none(mask)) return;
        RunningSumsOf<F> sums = walk.sums;
        carry_sums(sums, n, walk.last(), walk.cosine_over_pdf, job.options.heuristic);
        const auto environment = static_cast<std::uint32_t>(job.scene.emitters.size()) - 1;
        add_emission(mask, walk, EmitterOf<F>(at(job.scene.emitters, WordOf<F>(environment))),
                     walk.pdf_direction, F(pdf_area_disc(job.scene)),
                     walk.has(WalkStateOf<F>::previous_joinable), sums);
    }

    /// s >= 1, where `mask`.
    template <class F>
    HD void join(const MaskOf<F>& mask, const SampleIdOf<F>& id, const WordOf<F>& slot,
                 const WalkVertexOf<F>& v) const
    {
        if (none(mask)) return;
        const EyeVertexOf<F> z = eye_vertex<Integrator::bdpt, F>(job.options.heuristic, v);
        const UniformsOf<F> u = uniforms(id, Event::next_event, static_cast<std::uint32_t>(n));
        WaitingOf<F> result{{}, slot};
        push(waiting,
             next_event_candidate<needs, Integrator::bdpt, F>(job.scene, job.options, u, z, mask,
                                                              result.candidate),
             result);
        StoredEyeVertexOf<F> stored{z.point.position, z.point.clearance, z.facing, z.alpha,
                                    z.pdf_projected,  z.pdf_area,        {},       slot};
        for (int i = 0; i < 5; ++i) stored.brackets[i] = z.brackets[i];
        push(vertices, mask, stored);
    }
};

/// Over the eye vertices z_n: joins each to y_{s-1} of its sample, if there is one.
template <Needs needs>
struct Connect {
    static constexpr int least_blocks = stage_blocks;
    StageJob<needs> job;
    int n, s;
    BlockVertices block;
    Rows<StoredEyeVertexOf> vertices;
    Queue<WaitingOf> waiting;

    template <class Index>
    HD void operator()(const Index& index) const
    {
        using F = NumberTypeAt<Index>;
        const StoredEyeVertexOf<F> stored = load(vertices, index);
        EyeVertexOf<F> z{n + 1,
                         {stored.position, Vec3Of<F>(0.0f), stored.clearance, WordOf<F>(0u)},
                         stored.facing,
                         stored.alpha,
                         stored.pdf_projected,
                         stored.pdf_area,
                         {}};
        for (int i = 0; i < 5; ++i) z.brackets[i] = stored.brackets[i];
        const WordOf<F> sample =
            select(active_at(index), stored.slot - WordOf<F>(block.first_slot), WordOf<F>(0u));
        const auto before = static_cast<std::uint32_t>(s - 2);
        const MaskOf<F> active = active_at(index) && !(at(std::span<const std::uint32_t>(block.counts),
                                                          sample) < WordOf<F>(before + 1));
        if (none(active)) return;
        const LightVertexOf<F>& y =
            at(std::span<const LightVertex>(block.vertices), sample + WordOf<F>(before * block.samples));
        WaitingOf<F> result{{}, stored.slot};
        push(waiting,
             inner_connection_candidate<needs, F>(job.scene, job.options, s, y, z, active,
                                                  result.candidate),
             result);
    }
};

} // namespace fast
