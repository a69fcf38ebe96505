// Replaces device_ray_pairs.cu in a build without nvcc.

#include "cuda/launch/device.h"
#include "cuda/launch/ray_pairs.h"

#include <stdexcept>

namespace fast {

std::vector<PairOfHits> trace_ray_pairs_on_device(const SceneArrays& /*arrays*/,
                                                  std::span<const RayPair> /*pairs*/)
{
    throw std::runtime_error(describe_device());
}

} // namespace fast
