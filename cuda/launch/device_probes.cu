#include "cuda/launch/on_device.cuh"
#include "cuda/launch/probes.h"
#include "cuda/launch/run_probes.h"

namespace fast {

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
        return run_probes_in_scene<ProbeIrradiance, float>(memory, executor, arrays, probes);
    });
}

} // namespace fast
