#include "cuda/launch/on_device.cuh"
#include "cuda/launch/ray_pairs.h"
#include "cuda/launch/run_probes.h"

namespace fast {

std::vector<PairOfHits> trace_ray_pairs_on_device(const SceneArrays& arrays,
                                                  std::span<const RayPair> pairs)
{
    return on_device([&](DeviceMemory& memory, CudaExecutor& executor) {
        return run_probes_in_scene<TraceRayPairs, PairOfHits>(memory, executor, arrays, pairs);
    });
}

} // namespace fast
