#include "cuda/launch/batch_renderer.h"
#include "cuda/launch/launch_stages.h"
#include "cuda/launch/on_device.cuh"

#include <algorithm>

namespace fast {

using CudaStages = StagedExecutor<CudaExecutor>;

// Defined in device_path.cu, device_light.cu and device_bdpt.cu.
extern template void launch_samples<Integrator::path>(CudaExecutor&, Needs, const SceneInMemory&,
                                                      const SampleJob&);
extern template void launch_samples<Integrator::bdpt>(CudaExecutor&, Needs, const SceneInMemory&,
                                                      const SampleJob&);
extern template void launch_samples<Integrator::light>(CudaExecutor&, Needs, const SceneInMemory&,
                                                       const SampleJob&);
// Defined in device_path_stages.cu, device_light_stages.cu and device_bdpt_stages.cu.
extern template void launch_samples<Integrator::path>(CudaStages&, Needs, const SceneInMemory&,
                                                      const SampleJob&);
extern template void launch_samples<Integrator::bdpt>(CudaStages&, Needs, const SceneInMemory&,
                                                      const SampleJob&);
extern template void launch_samples<Integrator::light>(CudaStages&, Needs, const SceneInMemory&,
                                                       const SampleJob&);

namespace {

/// Throws an exception with the reason if there is no usable device.
struct UsableDevice {
    UsableDevice() { require_device(); }
};

/// The parts of a renderer on a GPU. The order of the members matters.
struct DeviceParts {
    UsableDevice device;
    Stream stream;
    DeviceMemory memory{stream.get()};
    CudaExecutor samples{stream.get()};
    CudaStages stages{memory, samples};
};

/// About a million samples keep a large GPU busy. They take 4 GiB at most, or half of the memory that is
/// free.
LaunchLimits limits()
{
    std::size_t free = 0;
    std::size_t total = 0;
    check(cudaMemGetInfo(&free, &total));
    return {1u << 15, 1u << 20, std::min(free / 2, std::size_t{4} << 30)};
}

/// `executor`: a member of DeviceParts.
template <class E>
class DeviceRenderer : private DeviceParts, public BatchRenderer<E> {
public:
    DeviceRenderer(E DeviceParts::*executor, const scenes::Scene& scene, int width, int height,
                   const images::RenderOptions& options, const RendererOptions& choices)
        : BatchRenderer<E>(memory, this->*executor, limits(), scene, width, height, options, choices)
    {}
};

} // namespace

std::unique_ptr<Renderer> device_renderer(const scenes::Scene& scene, int width, int height,
                                          const images::RenderOptions& options,
                                          const RendererOptions& choices)
{
    if (choices.kernels == DeviceKernels::stages)
        return std::make_unique<DeviceRenderer<CudaStages>>(&DeviceParts::stages, scene, width, height,
                                                            options, choices);
    return std::make_unique<DeviceRenderer<CudaExecutor>>(&DeviceParts::samples, scene, width, height,
                                                          options, choices);
}

} // namespace fast
