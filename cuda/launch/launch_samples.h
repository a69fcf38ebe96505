#pragma once

// Chooses the compiled kernel for the needs of a scene, which are known only at run time.

#include "cuda/scene/scene_in_memory.h"
#include "cuda/transport/render_samples.h"

#include <utility>

namespace fast {

/// All data of a launch except the scene.
struct SampleJob {
    PathOptions options;
    Launch launch;
    FilmTarget film;
    std::span<LightVertex> kept;
    int capacity;
    std::span<std::uint32_t> queues; // queue_words
};

/// Whether launches of samples on this executor run in stages (launch_stages.h).
template <class E>
inline constexpr bool in_stages = false;

/// The words of memory that launch_samples needs for the queues of so many samples. The kernel for whole
/// samples has none.
template <Executor E>
std::size_t queue_words(const E& /*executor*/, Integrator /*integrator*/, std::uint32_t /*samples*/)
{
    return 0;
}

/// In how many copies of `bytes` bytes each the splats of a batch are kept: one for all threads, to
/// which they add atomically.
template <Executor E>
std::uint32_t splat_copies(const E& /*executor*/, std::size_t /*bytes*/)
{
    return 1;
}

/// The executor that builds the tree of a scene: this one, unless it runs on another.
template <Executor E>
E& builder_of(E& executor)
{
    return executor;
}

/// Calls function.operator()<Needs>() with the smallest compiled needs that include these.
template <class Function>
void with_needs(const Needs& needs, const Function& function)
{
    const Needs chosen = compiled_for(needs);
    const auto try_needs = [&]<Needs compiled>() {
        if (chosen == compiled) function.template operator()<compiled>();
    };
    [&]<std::size_t... i>(std::index_sequence<i...>)
    {
        (try_needs.template operator()<compiled_needs[i]>(), ...);
    }
    (std::make_index_sequence<compiled_needs.size()>{});
}

/// Queues the samples of a job. Compiled once per integrator and executor, in a file of its own.
template <Integrator integrator, Executor E>
requires(!in_stages<E>) void launch_samples(E& executor, Needs needs, const SceneInMemory& scene,
                                            const SampleJob& job)
{
    with_needs(needs, [&]<Needs known>() {
        executor(job.launch.count(),
                 RenderSamples<known, integrator>{scene.view<known>(), job.options, job.launch, job.film,
                                                  job.kept, job.capacity});
    });
}

} // namespace fast
