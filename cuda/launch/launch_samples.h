#pragma once

// Chooses the compiled kernel for the needs of a scene, which are known only at run time.

#include "cuda/scene/scene_in_memory.h"
#include "cuda/transport/render_samples.h"

#include <type_traits>

namespace fast {

/// All data of a launch except the scene.
struct SampleJob {
    PathOptions options;
    Launch launch;
    FilmTarget film;
    std::span<LightVertex> kept;
    int capacity;
};

/// Calls function.operator()<Needs>() with these needs.
template <class Function>
void with_needs(Needs needs, const Function& function)
{
    const auto choose = [](bool condition, const auto& next) {
        if (condition)
            next(std::true_type{});
        else
            next(std::false_type{});
    };
    choose(needs.spheres, [&](auto spheres) {
        choose(needs.specular, [&](auto specular) {
            choose(needs.other_lights, [&](auto other_lights) {
                function.template operator()<Needs{spheres, specular, other_lights}>();
            });
        });
    });
}

/// Queues the samples of a job. Compiled once per integrator and executor, in a file of its own.
template <Integrator integrator, Executor E>
void launch_samples(E& executor, Needs needs, const SceneInMemory& scene, const SampleJob& job)
{
    with_needs(needs, [&]<Needs known>() {
        executor(job.launch.count(),
                 RenderSamples<known, integrator>{scene.view<known>(), job.options, job.launch, job.film,
                                                  job.kept, job.capacity});
    });
}

} // namespace fast
