#pragma once

// Pairs of rays, each pair a ray and the one that goes on from where it arrives, by the fast path.

#include "extremes/wing.h"

#include "cuda/launch/ray_pairs.h"

#include <span>
#include <vector>

namespace extremes {

/// What `pairs` meet, by Wing::host or Wing::cuda. Throws what both functions of ray_pairs.h throw.
inline std::vector<fast::PairOfHits> hits_of_pairs(Wing wing, const fast::SceneArrays& arrays,
                                                   std::span<const fast::RayPair> pairs)
{
    return wing == Wing::cuda ? fast::trace_ray_pairs_on_device(arrays, pairs)
                              : fast::trace_ray_pairs(arrays, pairs);
}

} // namespace extremes
