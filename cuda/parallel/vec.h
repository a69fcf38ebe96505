#pragma once

// Vectors of floats.

#include "cuda/parallel/host_device.h"

#if defined(__CUDACC__)
#pragma nv_diagnostic push
#pragma nv_diag_suppress 20012 // GLM marks defaulted constructors for the device, with no effect
#endif
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#if defined(__CUDACC__)
#pragma nv_diagnostic pop
#endif

namespace fast {

using Vec3 = glm::vec3;

HD inline float max_component(const Vec3& v)
{
    return glm::max(glm::max(v.x, v.y), v.z);
}

/// Coordinate `axis`. On a GPU an array that is indexed at run time lies in memory, so there the
/// coordinate is chosen by comparisons.
HD inline float coordinate(const Vec3& v, int axis)
{
#if defined(__CUDA_ARCH__)
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
#else
    return (&v.x)[axis];
#endif
}

/// After x comes y, then z, then x again. A choice takes fewer registers of a GPU; on other processors
/// it would be a branch, often predicted wrongly.
HD inline int next_axis(int axis)
{
#if defined(__CUDA_ARCH__)
    return axis == 2 ? 0 : axis + 1;
#else
    return 0b00'10'01 >> 2 * axis & 3;
#endif
}

} // namespace fast
