#include "cuda/launch/ray_pairs.h"

#include "cuda/launch/run_probes.h"
#include "cuda/parallel/executor.h"

namespace fast {

std::vector<PairOfHits> trace_ray_pairs(const SceneArrays& arrays, std::span<const RayPair> pairs)
{
    HostMemory memory;
    SerialExecutor executor;
    return run_probes_in_scene<TraceRayPairs, PairOfHits>(memory, executor, arrays, pairs);
}

} // namespace fast
