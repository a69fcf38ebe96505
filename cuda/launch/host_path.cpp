// Path tracing in stages on the threads of the host, for one instruction set.

#include "cuda/launch/host_stages.h"
#include "cuda/stages/trace_paths.h"

void PLUMBLINE_KERNELS_OF(path)(fast::HostThreads& threads, fast::Needs needs,
                                const fast::SceneInMemory& scene, const fast::SampleJob& job)
{
    fast::with_needs(needs, [&]<fast::Needs known>() {
        // Paths add only to their own pixels.
        const fast::StageJob<known> stages{scene.view<known>(), job.options, job.launch, job.film};
        fast::trace_blocks<fast::PathMemory>(threads, job.launch.count(), 1024,
                                             [&](fast::PathMemory& memory, std::uint32_t /*thread*/,
                                                 std::uint32_t first, std::uint32_t count) {
                                                 fast::StageExecutor executor;
                                                 fast::HostStages run(executor);
                                                 memory.trace(run, stages, first, count);
                                             });
    });
}
