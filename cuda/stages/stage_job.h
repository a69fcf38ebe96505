#pragma once

// What the stages of all integrators share: the job of a launch, the two stages that trace rays, and the
// contributions that wait for them.

#include "cuda/stages/film_add.h"
#include "cuda/stages/rows.h"
#include "cuda/transport/eye_subpath.h"
#include "cuda/transport/render_samples.h"

namespace fast {

/// A contribution that waits for the test of its ray.
template <class F>
struct WaitingOf {
    CandidateOf<F> candidate;
    WordOf<F> slot;
};

/// Four blocks of a stage fit on a multiprocessor of a GPU, for half of the threads that it can hold at
/// most (cuda/parallel/executor.cuh).
constexpr int stage_blocks = 4;

/// What a stage does at a vertex of its paths: all of it; or only the bounce, with the emission; or only
/// the joins to other vertices. In parts, each stage computes the vertex again, and a GPU needs fewer
/// registers for it (docs/gpu.md).
enum class Part { all, bounce, joins };

constexpr bool includes(Part part, Part other)
{
    return part == Part::all || part == other;
}

/// What all stages of a launch have in common.
template <Needs needs>
struct StageJob {
    SceneView<needs> scene;
    PathOptions options;
    Launch launch;
    FilmTarget film;

    template <class F>
    [[nodiscard]] HD SampleIdOf<F> id_of(const WordOf<F>& slot) const
    {
        WordOf<F> pixel;
        const WordOf<F> sample = divided(slot, launch.pixels, pixel);
        return {options.seed, pixel + launch.first_pixel, sample + launch.first_sample};
    }
    /// Adds to the samples of these slots, where `mask`.
    template <class F>
    HD void add(const MaskOf<F>& mask, const WordOf<F>& slot, int s, int t, const Vec3Of<F>& value,
                const F& weight) const
    {
        film_add(film, launch, mask, slot, s, t, value, weight);
    }
};

/// Over unfinished paths.
template <Needs needs, template <class> class State>
struct Extend {
    static constexpr int least_blocks = stage_blocks;
    StageJob<needs> job;
    Rows<State> paths;
    Rows<HitOf> hits; // of the same indices

    template <class Index>
    HD void operator()(const Index& index) const
    {
        using F = NumberTypeAt<Index>;
        const State<F> path = load(paths, index);
        store(hits, index,
              closest_hits(
                  job.scene,
                  RayOf<F>{path.origin, F(std::numeric_limits<float>::infinity()), path.direction},
                  active_at(index)));
    }
};

/// Over candidates of the strategy (s, t), which add to their own pixels.
template <Needs needs>
struct TestShadow {
    static constexpr int least_blocks = stage_blocks;
    StageJob<needs> job;
    int s, t;
    Rows<WaitingOf> waiting;

    template <class Index>
    HD void operator()(const Index& index) const
    {
        using F = NumberTypeAt<Index>;
        const WaitingOf<F> one = load(waiting, index);
        const MaskOf<F> active = active_at(index);
        job.add(active && !occluded_rays(job.scene, one.candidate.ray, active), one.slot, s, t,
                one.candidate.value, one.candidate.weight);
    }
};

} // namespace fast
