#include "cuda/launch/device.h"
#include "cuda/launch/run_probes.h"
#include "cuda/parallel/device_memory.cuh"
#include "cuda/parallel/executor.cuh"
#include "cuda/parallel/primitives.cuh"
#include "cuda/parallel/stream.cuh"

#include <stdexcept>

namespace fast {

namespace {

/// run(memory, executor) on the first GPU.
template <class Run>
auto on_device(const Run& run)
{
    if (const Device device = find_device(); !device.usable)
        throw std::runtime_error(device.description);
    const Stream stream;
    DeviceMemory memory(stream.get());
    CudaExecutor executor(stream.get());
    return run(memory, executor);
}

} // namespace

std::vector<ProbedGlass> probe_glass_on_device(std::span<const GlassProbe> probes)
{
    return on_device([&](DeviceMemory& memory, CudaExecutor& executor) {
        return run_probes<ProbeGlass, ProbedGlass>(memory, executor, probes);
    });
}

std::vector<ProbedCamera> probe_camera_on_device(std::span<const CameraProbe> probes)
{
    return on_device([&](DeviceMemory& memory, CudaExecutor& executor) {
        return run_probes<ProbeCamera, ProbedCamera>(memory, executor, probes);
    });
}

std::vector<float> probe_irradiance_on_device(const SceneArrays& arrays,
                                              std::span<const PointProbe> probes)
{
    return on_device([&](DeviceMemory& memory, CudaExecutor& executor) {
        return run_irradiance(memory, executor, arrays, probes);
    });
}

} // namespace fast
