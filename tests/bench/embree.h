#pragma once

// Embree for comparison, if it is installed: its Morton builder (low quality) or its binned SAH
// (medium), in single precision.

#include "ref/trees/ray.h"

#include <benchmark/benchmark.h>

#include <vector>

namespace bench {

#ifdef PLUMBLINE_HAVE_EMBREE
constexpr bool have_embree = true;
#else
constexpr bool have_embree = false;
#endif

struct EmbreeOptions {
    bool medium = false; // quality
    bool robust = false; // watertight, as the fast path is: by default a ray may pass between triangles
    unsigned threads = 1;
};

/// Times the building of a tree over the scene's triangles; spheres are left out.
void embree_build(benchmark::State& state, const scenes::Scene& scene, EmbreeOptions options = {});

/// Times the closest hits of `rays`.
void embree_trace(benchmark::State& state, const scenes::Scene& scene, const std::vector<ref::Ray>& rays,
                  EmbreeOptions options = {});

} // namespace bench
