// Light tracing in stages on the threads of the host, for one instruction set.

#include "cuda/launch/host_stages.h"
#include "cuda/stages/trace_walks.h"

void PLUMBLINE_KERNELS_OF(light)(fast::HostThreads& threads, fast::Needs needs,
                                 const fast::SceneInMemory& scene, const fast::SampleJob& job)
{
    fast::with_needs(needs, [&]<fast::Needs known>() {
        const fast::StageJob<known> stages{scene.view<known>(), job.options, job.launch, job.film};
        fast::trace_blocks<fast::WalkMemory>(
            threads, job.launch.count(), 512,
            [&](fast::WalkMemory& memory, std::uint32_t first, std::uint32_t count) {
                const auto each = static_cast<std::size_t>(job.capacity);
                memory.trace<fast::Integrator::light>(fast::StageExecutor(), stages, first, count,
                                                      job.kept.subspan(first * each, count * each),
                                                      job.capacity);
            });
    });
}
