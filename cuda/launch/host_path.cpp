// Path tracing in stages on the threads of the host, for one instruction set.

#include "cuda/launch/host_kernels.h"
#if defined(__AVX2__)
#include "cuda/stages/floats_film_add.h"
#include "cuda/stages/floats_rows.h"
#include "cuda/stages/floats_trace_rays.h"
#include "cuda/transport/floats_random.h"
#endif
#include "cuda/stages/trace_paths.h"
#include "cuda/stages/trace_rays.h"

namespace fast {

namespace {

/// Runs the stages of one thread over a scene.
template <Needs needs>
auto stage_executor([[maybe_unused]] const SceneView<needs>& scene)
{
#if defined(__AVX2__)
    return FloatsExecutor(true);
#else
    return SerialExecutor();
#endif
}

/// Paths that a thread traces together: their queues fit into the cache of a core.
constexpr std::uint32_t paths_per_block = 1024;

/// Over the threads: each takes one block of the launch after the other.
template <Needs needs>
struct TraceBlocks {
    PathJob<needs> job;
    std::span<std::uint32_t> words; // of all threads
    std::atomic<std::uint32_t>* next_block;

    void operator()(std::uint32_t thread) const
    {
        constexpr std::size_t each = PathMemory::words_for(paths_per_block);
        PathMemory memory(words.subspan(thread * each, each), paths_per_block);
        const std::uint32_t all = job.launch.count();
        const auto run = stage_executor(job.scene);
        for (;;) {
            const std::uint32_t block = next_block->fetch_add(1, std::memory_order_relaxed);
            if (block >= (all + paths_per_block - 1) / paths_per_block) return;
            const std::uint32_t first = block * paths_per_block;
            memory.trace(run, job, first, std::min(paths_per_block, all - first));
        }
    }
};

} // namespace

} // namespace fast

void PLUMBLINE_KERNELS_OF(path)(fast::HostThreads& threads, fast::Needs needs,
                                const fast::SceneInMemory& scene, const fast::SampleJob& job)
{
    threads.path_words.resize(threads.width() * fast::PathMemory::words_for(fast::paths_per_block));
    std::atomic<std::uint32_t> next_block = 0;
    fast::with_needs(needs, [&]<fast::Needs known>() {
        threads(threads.width(),
                fast::TraceBlocks<known>{{scene.view<known>(), job.options, job.launch, job.film},
                                         threads.path_words,
                                         &next_block});
    });
}
