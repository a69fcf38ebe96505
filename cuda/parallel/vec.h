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

} // namespace fast
