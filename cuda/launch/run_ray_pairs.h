#pragma once

#include "cuda/launch/ray_pairs.h"
#include "cuda/scene/scene_in_memory.h"

namespace fast {

/// trace_ray_pairs with any memory and executor.
template <Executor E>
std::vector<PairOfHits> run_ray_pairs(Memory& memory, E& executor, const SceneArrays& arrays,
                                      std::span<const RayPair> pairs)
{
    const SceneInMemory scene(memory, executor, arrays, Camera{});
    const Buffer<RayPair> asked(memory, pairs);
    Buffer<PairOfHits> hits(memory, pairs.size());
    executor(static_cast<std::uint32_t>(pairs.size()),
             TraceRayPairs<any_needs>{scene.view<any_needs>(), asked.all(), hits.all()});
    return hits.read(pairs.size());
}

} // namespace fast
