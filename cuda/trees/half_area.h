#pragma once

// What makes a box likely to be hit.

#include "cuda/trees/box.h"

namespace gpu {

/// Half the surface area of a box that is not empty.
HD inline float half_area(const Box& box)
{
    const Vec3 d = box.upper - box.lower;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

} // namespace gpu
