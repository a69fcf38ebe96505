#include "cuda/launch/batch_renderer.h"
#include "cuda/launch/host_kernels.h"

namespace fast {

namespace {

/// Blocks of so few neighbours that no thread waits long for another at the end of a launch.
constexpr std::uint32_t most_per_block = 32;

/// Always as many samples at once: so that on one thread even sums of floats are the same every time.
constexpr LaunchLimits limits{8192, 8192, std::size_t{1} << 30};

/// What a renderer on the host consists of; the order matters.
struct HostParts {
    explicit HostParts(unsigned threads) : executor(threads, most_per_block) {}
    HostMemory memory;
    ThreadedExecutor executor;
};

class HostRenderer : private HostParts, public BatchRenderer<ThreadedExecutor> {
public:
    HostRenderer(const scenes::Scene& scene, int width, int height, const images::RenderOptions& options,
                 unsigned threads, Needs at_least)
        : HostParts(threads),
          BatchRenderer(memory, executor, limits, scene, width, height, options, at_least)
    {}
};

} // namespace

std::unique_ptr<Renderer> host_renderer(const scenes::Scene& scene, int width, int height,
                                        const images::RenderOptions& options, unsigned threads,
                                        Needs at_least)
{
    return std::make_unique<HostRenderer>(scene, width, height, options, threads, at_least);
}

} // namespace fast
