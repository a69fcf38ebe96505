#include "cuda/launch/device.h"
#include "cuda/launch/run_ray_pairs.h"
#include "cuda/parallel/device_memory.cuh"
#include "cuda/parallel/executor.cuh"
#include "cuda/parallel/primitives.cuh"
#include "cuda/parallel/stream.cuh"

#include <stdexcept>

namespace fast {

std::vector<PairOfHits> trace_ray_pairs_on_device(const SceneArrays& arrays,
                                                  std::span<const RayPair> pairs)
{
    if (const Device device = find_device(); !device.usable)
        throw std::runtime_error(device.description);
    const Stream stream;
    DeviceMemory memory(stream.get());
    CudaExecutor executor(stream.get());
    return run_ray_pairs(memory, executor, arrays, pairs);
}

} // namespace fast
