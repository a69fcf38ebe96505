#include "cuda/launch/batch_renderer.h"
#include "cuda/launch/device.h"
#include "cuda/parallel/device_memory.cuh"
#include "cuda/parallel/executor.cuh"
#include "cuda/parallel/primitives.cuh"
#include "cuda/parallel/stream.cuh"

namespace fast {

// Defined in device_path.cu, device_light.cu and device_bdpt.cu.
extern template void launch_samples<Integrator::path>(CudaExecutor&, Needs, const SceneInMemory&,
                                                      const SampleJob&);
extern template void launch_samples<Integrator::bdpt>(CudaExecutor&, Needs, const SceneInMemory&,
                                                      const SampleJob&);
extern template void launch_samples<Integrator::light>(CudaExecutor&, Needs, const SceneInMemory&,
                                                       const SampleJob&);

namespace {

/// Throws an exception with the reason if there is no usable device.
struct UsableDevice {
    UsableDevice()
    {
        if (const Device device = find_device(); !device.usable)
            throw std::runtime_error(device.description);
    }
};

/// The parts of a renderer on a GPU. The order of the members matters.
struct DeviceParts {
    UsableDevice device;
    Stream stream;
    DeviceMemory memory{stream.get()};
    CudaExecutor executor{stream.get()};
};

/// About a million samples keep a large GPU busy.
constexpr LaunchLimits limits{1u << 15, 1u << 20, std::size_t{4} << 30};

class DeviceRenderer : private DeviceParts, public BatchRenderer<CudaExecutor> {
public:
    DeviceRenderer(const scenes::Scene& scene, int width, int height,
                   const images::RenderOptions& options, Needs at_least)
        : BatchRenderer(memory, executor, limits, scene, width, height, options, at_least)
    {}
};

} // namespace

std::unique_ptr<Renderer> device_renderer(const scenes::Scene& scene, int width, int height,
                                          const images::RenderOptions& options, Needs at_least)
{
    return std::make_unique<DeviceRenderer>(scene, width, height, options, at_least);
}

} // namespace fast
