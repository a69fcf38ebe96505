#pragma once

// Bidirectional path tracing in stages [van Antwerpen 2011; Davidovic et al. 2014]: first the light
// walks of all samples, whose vertices are stored, then their eye walks. Number types, queues and the
// order of contributions are as in path_stages.h.
//
//   generate_light   y_0 of each sample, its light image, and the first ray
//   shade_light      stores y_n; a candidate for its light image; the bounce
//   test_splat       adds the light images whose ray is not occluded, to any pixel
//   generate_eye     the ray of each sample through its pixel
//   shade_eye        emission where the walk has come to; a candidate of next event estimation; the
//   bounce connect          candidates of the connections of z_n to the stored y_{s-1}, for one s
//
// Extend and test_shadow are those of stage_job.h. Light tracing is the first half.

#include "cuda/stages/stage_job.h"
#include "cuda/transport/light_subpath.h"

namespace fast {

/// An unfinished walk, and its ray to the next vertex.
template <class F>
struct WalkStateOf {
    Vec3Of<F> origin; // of the ray
    Vec3Of<F> direction;
    Vec3Of<F> from; // the vertex that the ray leaves
    F pdf_direction, cosine_over_pdf;
    Vec3Of<F> alpha;
    WordOf<F> flags;     // the three below
    F pdf_rev, survival; // LastBounceOf
    RunningSumsOf<F> sums;
    WordOf<F> slot; // the index of the sample in the launch

    static constexpr std::uint32_t joinable = 1; // LastBounceOf
    static constexpr std::uint32_t previous_joinable = 2;
    static constexpr std::uint32_t from_infinity = 4;

    [[nodiscard]] HD MaskOf<F> has(std::uint32_t flag) const
    {
        return (flags & WordOf<F>(flag)) != WordOf<F>(0u);
    }
    [[nodiscard]] HD static WordOf<F> flag_where(const MaskOf<F>& mask, std::uint32_t flag)
    {
        return select(mask, WordOf<F>(flag), WordOf<F>(0u));
    }
    [[nodiscard]] HD LegOf<F> leg() const
    {
        return {{origin, F(std::numeric_limits<float>::infinity()), direction},
                from,
                has(from_infinity),
                pdf_direction,
                cosine_over_pdf};
    }
    HD void set_leg(const LegOf<F>& leg)
    {
        origin = leg.ray.origin;
        direction = leg.ray.direction;
        from = leg.from;
        pdf_direction = leg.pdf_direction;
        cosine_over_pdf = leg.cosine_over_pdf;
    }
    [[nodiscard]] HD LastBounceOf<F> last() const { return {has(joinable), pdf_rev, survival}; }
};

/// A light image that waits for the test of its ray.
template <class F>
struct WaitingSplatOf {
    CandidateOf<F> candidate;
    WordOf<F> pixel, slot;
};

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

/// The light vertices of the samples of a block: y_n of sample number i at [(n - 1) samples + i].
struct BlockVertices {
    std::uint32_t first_slot, samples;
    std::span<LightVertex> vertices;
    std::span<std::uint32_t> counts; // of each sample
};

/// Over the samples of a block.
template <Needs needs, Integrator integrator>
struct GenerateLight {
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
        WaitingSplatOf<F> image{{}, WordOf<F>(0u), walk.slot};
        push(waiting,
             image_of_emitter_candidate<needs, integrator, F>(scene, job.options, emission, active,
                                                              image.candidate, image.pixel),
             image);
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

/// The vertex that a walk has come to, with its sums; and where `active`, if it has.
template <Needs needs, class F>
HD WalkVertexOf<F> walk_vertex(const StageJob<needs>& job, int n, const WalkStateOf<F>& walk,
                               const HitOf<F>& hit, MaskOf<F>& active, MetSurfaceOf<F>& met)
{
    const LegOf<F> leg = walk.leg();
    met = meet_surface<needs, F>(job.scene, leg, hit, active);
    active = active && met.pdf_area > 0.0f; // else in the plane of the surface: the density is 0
    RunningSumsOf<F> sums = walk.sums;
    carry_sums(sums, n, walk.last(), leg.cosine_over_pdf * met.inverse_distance2, job.options.heuristic);
    return {met.point,
            met.wo,
            met.facing,
            met.cosine,
            met.material,
            met.emitter,
            n,
            walk.alpha,
            walk.has(WalkStateOf<F>::previous_joinable),
            met.pdf_area,
            sums};
}

/// The walk after the bounce at vertex v; returns where it goes on.
template <Needs needs, class F>
HD MaskOf<F> next_walk(const WalkVertexOf<F>& v, const MetSurfaceOf<F>& met, const SampleIdOf<F>& id,
                       Transport carried, WalkStateOf<F>& walk)
{
    using Walk = WalkStateOf<F>;
    const Event event = carried == Transport::radiance ? Event::eye_bounce : Event::light_bounce;
    LegOf<F> leg;
    const MaskOf<F> goes_on =
        bounce<needs, F>(met, v.n, uniforms(id, event, static_cast<std::uint32_t>(v.n)), carried, leg,
                         walk.alpha, walk.pdf_rev);
    walk.set_leg(leg);
    walk.flags = Walk::flag_where(v.previous_joinable && scatters(v.material), Walk::joinable) |
                 Walk::flag_where(scatters(v.material), Walk::previous_joinable);
    walk.survival = v.material.survival;
    walk.sums = v.sums;
    return goes_on && !is_black(walk.alpha);
}

/// Over unfinished light walks, at their vertex n.
template <Needs needs, Integrator integrator>
struct ShadeLight {
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
        const Vec3Of<F> alpha = y.alpha * y.material.color * F(inverse_pi);
        const MaskOf<F> joinable = active && scatters(y.material);
        WaitingSplatOf<F> image{{}, WordOf<F>(0u), walk.slot};
        push(waiting,
             light_image_candidate<needs, integrator, F>(
                 job.scene, job.options, n + 1, y.point, y.facing, y.pdf_area,
                 y.bracket(1, job.options.heuristic), alpha, joinable, image.candidate, image.pixel),
             image);
        if constexpr (integrator == Integrator::bdpt) keep(active, joinable, walk.slot, y, alpha);
        if (last) return;
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

/// Over the samples of a block.
template <Needs needs>
struct GenerateEye {
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
template <Needs needs>
struct ShadeEye {
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
        if (scene.has_environment) add_environment(active_at(index) && !active, walk);
        if (none(active)) return;
        hit.primitive = select(active, hit.primitive, WordOf<F>(0u)); // any that exists
        MetSurfaceOf<F> met;
        const WalkVertexOf<F> v = walk_vertex(job, n, walk, hit, active, met);
        const MaskOf<F> emits =
            active && v.emitter != WordOf<F>(no_emitter) && glm::dot(v.point.normal, v.wo) > 0.0f;
        if (any(emits))
            add_emission(emits, walk,
                         EmitterOf<F>(at(scene.emitters, select(emits, v.emitter, WordOf<F>(0u)))),
                         v.pdf_area, v.pdf_rev_solid_angle(), v.previous_joinable, v.sums);
        if (n == job.options.max_edges) return;
        const SampleIdOf<F> id = job.template id_of<F>(walk.slot);
        if (!scene.cumulative.empty()) join(active && scatters(v.material), id, walk.slot, v);
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
        const LightVertexOf<F> y =
            at(std::span<const LightVertex>(block.vertices), sample + WordOf<F>(before * block.samples));
        WaitingOf<F> result{{}, stored.slot};
        push(waiting,
             inner_connection_candidate<needs, F>(job.scene, job.options, s, y, z, active,
                                                  result.candidate),
             result);
    }
};

} // namespace fast
