#include "cuda/launch/batch_renderer.h"
#include "cuda/launch/host_kernels.h"

namespace fast {

namespace {

/// Small blocks of neighbouring indices: at the end of a launch no thread waits long for another.
constexpr std::uint32_t most_per_block = 32;

/// A constant number of samples per launch, so that on one thread even sums of floats are always the
/// same. At its end each thread waits for the last block of the others (host_stages.h): a launch has
/// many blocks.
constexpr LaunchLimits limits{1u << 16, 1u << 16, std::size_t{1} << 28};

/// The parts of a renderer on the host. The order of the members matters.
struct HostParts {
    HostParts(unsigned threads, InstructionSet instructions) : executor(threads, most_per_block)
    {
        executor.instructions = instructions;
    }
    HostMemory memory;
    HostThreads executor;
};

class HostRenderer : private HostParts, public BatchRenderer<HostThreads> {
public:
    HostRenderer(const scenes::Scene& scene, int width, int height, const images::RenderOptions& options,
                 unsigned threads, const RendererOptions& choices)
        : HostParts(threads, choices.instructions),
          BatchRenderer(memory, executor, limits, scene, width, height, options, choices)
    {}
};

} // namespace

std::unique_ptr<Renderer> host_renderer(const scenes::Scene& scene, int width, int height,
                                        const images::RenderOptions& options, unsigned threads,
                                        const RendererOptions& choices)
{
    return std::make_unique<HostRenderer>(scene, width, height, options, threads, choices);
}

} // namespace fast
