#pragma once

#include "cuda/scene/scene_arrays.h"
#include "cuda/transport/ray_pairs.h"

#include <span>
#include <vector>

namespace fast {

/// The hits of `pairs` in a scene, whose unit of length is that of the arrays, computed by one thread of
/// the host. Throws the exceptions of SurfaceTree.
std::vector<PairOfHits> trace_ray_pairs(const SceneArrays& arrays, std::span<const RayPair> pairs);

/// The same on the first GPU. Throws std::runtime_error if there is none, or if the program was built
/// without nvcc, and OutOfMemory.
std::vector<PairOfHits> trace_ray_pairs_on_device(const SceneArrays& arrays,
                                                  std::span<const RayPair> pairs);

} // namespace fast
