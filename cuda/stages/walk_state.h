#pragma once

// An unfinished walk of bidirectional path tracing, from one vertex to the next, and the light vertices
// that are kept for the eye walks.

#include "cuda/stages/stage_job.h"
#include "cuda/transport/light_vertex.h"

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

/// The light vertices of the samples of a block: y_n of sample number i at [(n - 1) samples + i].
struct BlockVertices {
    std::uint32_t first_slot, samples;
    std::span<LightVertex> vertices;
    std::span<std::uint32_t> counts; // of each sample
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

} // namespace fast
