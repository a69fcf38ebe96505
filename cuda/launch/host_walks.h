#pragma once

// The launch that bidirectional path tracing and light tracing share (host_bdpt.cpp, host_light.cpp).

#include "cuda/launch/host_stages.h"
#include "cuda/stages/trace_walks.h"

namespace fast {

namespace {

template <Integrator integrator>
void launch_walks(HostThreads& threads, Needs needs, const SceneInMemory& scene, const SampleJob& job)
{
    with_needs(needs, [&]<Needs known>() {
        using Memory = WalkMemory<integrator>;
        trace_blocks<Memory>(
            threads, job.launch.count(), 512,
            [&](Memory& memory, std::uint32_t thread, std::uint32_t first, std::uint32_t count) {
                const StageJob<known> stages{scene.view<known>(), job.options, job.launch,
                                             job.film.of_thread(thread, threads.width())};
                const auto each = static_cast<std::size_t>(job.capacity);
                StageExecutor executor;
                HostStages run(executor);
                memory.trace(run, stages, first, count, job.kept.subspan(first * each, count * each),
                             job.capacity);
            });
    });
}

} // namespace

} // namespace fast
