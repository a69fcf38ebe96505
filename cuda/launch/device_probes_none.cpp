// Replaces device_probes.cu in a build without nvcc.

#include "cuda/launch/device.h"
#include "cuda/launch/probes.h"

#include <stdexcept>

namespace fast {

std::vector<ProbedGlass> probe_glass_on_device(std::span<const GlassProbe> /*probes*/)
{
    throw std::runtime_error(describe_device());
}

std::vector<ProbedCamera> probe_camera_on_device(std::span<const CameraProbe> /*probes*/)
{
    throw std::runtime_error(describe_device());
}

std::vector<float> probe_irradiance_on_device(const SceneArrays& /*arrays*/,
                                              std::span<const PointProbe> /*probes*/)
{
    throw std::runtime_error(describe_device());
}

} // namespace fast
