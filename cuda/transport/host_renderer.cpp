#include "cuda/parallel/threaded_executor.h"
#include "cuda/transport/batch_renderer.h"

namespace gpu {

// In host_path.cpp and its like.
extern template void launch_samples<Integrator::path>(ThreadedExecutor&, Needs, const SceneInMemory&,
                                                      const SampleJob&);
extern template void launch_samples<Integrator::bdpt>(ThreadedExecutor&, Needs, const SceneInMemory&,
                                                      const SampleJob&);
extern template void launch_samples<Integrator::light>(ThreadedExecutor&, Needs, const SceneInMemory&,
                                                       const SampleJob&);

namespace {

/// Blocks of so few neighbours that no thread waits long for another at the end of a launch.
constexpr std::uint32_t most_per_block = 32;

/// What a renderer on the host consists of; the order matters.
struct HostParts {
    explicit HostParts(unsigned threads) : executor(threads, most_per_block) {}
    HostMemory memory;
    ThreadedExecutor executor;
};

class HostRenderer : private HostParts, public BatchRenderer<ThreadedExecutor> {
public:
    HostRenderer(const scenes::Scene& scene, int width, int height, const RenderOptions& options,
                 unsigned threads)
        : HostParts(threads),
          BatchRenderer(memory, executor, LaunchSize(1024, 16384), scene, width, height, options)
    {}
};

} // namespace

std::unique_ptr<Renderer> host_renderer(const scenes::Scene& scene, int width, int height,
                                        const RenderOptions& options, unsigned threads)
{
    return std::make_unique<HostRenderer>(scene, width, height, options, threads);
}

} // namespace gpu
