#include "cuda/launch/probes.h"

#include "cuda/launch/run_probes.h"
#include "cuda/parallel/executor.h"

namespace fast {

std::vector<ProbedGlass> probe_glass(std::span<const GlassProbe> probes)
{
    HostMemory memory;
    SerialExecutor executor;
    return run_probes<ProbeGlass, ProbedGlass>(memory, executor, probes);
}

std::vector<ProbedCamera> probe_camera(std::span<const CameraProbe> probes)
{
    HostMemory memory;
    SerialExecutor executor;
    return run_probes<ProbeCamera, ProbedCamera>(memory, executor, probes);
}

std::vector<float> probe_irradiance(const SceneArrays& arrays, std::span<const PointProbe> probes)
{
    HostMemory memory;
    SerialExecutor executor;
    return run_probes_in_scene<ProbeIrradiance, float>(memory, executor, arrays, probes);
}

} // namespace fast
