#pragma once

// The stages of light walks (bdpt_stages.h).

#include "cuda/stages/walk_state.h"
#include "cuda/transport/light_subpath.h"

namespace fast {

/// A light image that waits for the test of its ray.
template <class F>
struct WaitingSplatOf {
    CandidateOf<F> candidate;
    WordOf<F> pixel, slot;
};

/// Over the samples of a block.
template <Needs needs, Integrator integrator, Part part>
struct GenerateLight {
    static constexpr int least_blocks = stage_blocks;
    StageJob<needs> job;
    BlockVertices block;
    Queue<WalkStateOf> walks;
    Queue<WaitingSplatOf> waiting;

    template <class Index>
    HD void operator()(const Index& index) const
    {
        using F = NumberTypeAt<Index>;
        using Walk = WalkStateOf<F>;
        const SceneView<needs>& scene = job.scene;
        const MaskOf<F> active = active_at(index);
        Walk walk{};
        walk.slot = index_of(index) + block.first_slot;
        const SampleIdOf<F> id = job.template id_of<F>(walk.slot);
        const SampledEmissionOf<F> emission =
            sample_emission<needs, F>(scene, uniforms(id, Event::emission_position),
                                      uniforms(id, Event::emission_direction), active);
        if constexpr (includes(part, Part::joins)) {
            WaitingSplatOf<F> image{{}, WordOf<F>(0u), walk.slot};
            push(waiting,
                 image_of_emitter_candidate<needs, integrator, F>(scene, job.options, emission, active,
                                                                  image.candidate, image.pixel),
                 image);
        }
        if constexpr (!includes(part, Part::bounce)) return;
        const LegOf<F> leg = first_leg<needs, F>(scene, emission);
        walk.set_leg(leg);
        walk.alpha = emission.alpha;
        walk.flags =
            Walk::flag_where(can_be_hit<needs>(EmitterOf<F>(at(scene.emitters, emission.emitter))),
                             Walk::joinable) |
            WordOf<F>(Walk::previous_joinable) |
            Walk::flag_where(leg.from_infinity, Walk::from_infinity);
        walk.survival = F(1.0f);
        push(walks, active && !is_black(walk.alpha), walk);
    }
};

/// Over unfinished light walks, at their vertex n.
template <Needs needs, Integrator integrator, Part part>
struct ShadeLight {
    static constexpr int least_blocks = stage_blocks;
    StageJob<needs> job;
    int n;
    bool last; // whether walks end here
    BlockVertices block;
    Rows<WalkStateOf> walks;
    Rows<HitOf> hits;
    Queue<WalkStateOf> next;
    Queue<WaitingSplatOf> waiting;

    template <class Index>
    HD void operator()(const Index& index) const
    {
        using F = NumberTypeAt<Index>;
        WalkStateOf<F> walk = load(walks, index);
        HitOf<F> hit = load(hits, index);
        MaskOf<F> active = active_at(index) && hit.primitive != WordOf<F>(no_primitive);
        if (none(active)) return;
        hit.primitive = select(active, hit.primitive, WordOf<F>(0u)); // any that exists
        MetSurfaceOf<F> met;
        const WalkVertexOf<F> y = walk_vertex(job, n, walk, hit, active, met);
        if constexpr (includes(part, Part::joins)) {
            const Vec3Of<F> alpha = y.alpha * y.material.color * F(inverse_pi);
            const MaskOf<F> joinable = active && scatters(y.material);
            if constexpr (integrator == Integrator::bdpt) keep(active, joinable, walk.slot, y, alpha);
            WaitingSplatOf<F> image{{}, WordOf<F>(0u), walk.slot};
            push(waiting,
                 light_image_candidate<needs, integrator, F>(
                     job.scene, job.options, n + 1, y.point, y.facing, y.pdf_area,
                     y.bracket(1, job.options.heuristic), alpha, joinable, image.candidate, image.pixel),
                 image);
        }
        if (!includes(part, Part::bounce) || last) return;
        const MaskOf<F> goes_on =
            next_walk<needs, F>(y, met, job.template id_of<F>(walk.slot), Transport::power, walk);
        push(next, active && goes_on, walk);
    }

private:
    template <class F>
    HD void keep(const MaskOf<F>& active, const MaskOf<F>& joinable, const WordOf<F>& slot,
                 const WalkVertexOf<F>& y, const Vec3Of<F>& alpha) const
    {
        const WordOf<F> sample = slot - WordOf<F>(block.first_slot);
        LightVertexOf<F> vertex = light_vertex<needs, F>(job.scene, job.options.heuristic, y, alpha);
        vertex.alpha = select(joinable, vertex.alpha, Vec3Of<F>(0.0f));
        put_at(block.vertices, sample + WordOf<F>(static_cast<std::uint32_t>(n - 1) * block.samples),
               active, vertex);
        put_at(block.counts, sample, active, WordOf<F>(static_cast<std::uint32_t>(n)));
    }
};

/// Over light images of y_{s-1}.
template <Needs needs>
struct TestSplat {
    static constexpr int least_blocks = stage_blocks;
    StageJob<needs> job;
    int s;
    Rows<WaitingSplatOf> waiting;

    template <class Index>
    HD void operator()(const Index& index) const
    {
        using F = NumberTypeAt<Index>;
        const WaitingSplatOf<F> one = load(waiting, index);
        const MaskOf<F> active = active_at(index);
        film_splat(job.film, active && !occluded_rays(job.scene, one.candidate.ray, active), one.pixel,
                   s, one.candidate.value, one.candidate.weight);
    }
};

} // namespace fast
