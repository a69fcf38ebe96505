#pragma once

// Axis-aligned boxes.

#include "cuda/parallel/number.h"

namespace fast {

/// All points between two corners, faces included.
struct Aabb {
    Vec3 lower;
    Vec3 upper;
};

/// The neutral element of `unite`.
HD inline Aabb empty_aabb()
{
    constexpr float infinity = __builtin_huge_valf();
    return {Vec3(infinity), Vec3(-infinity)};
}

/// The smallest box around both; rounds nothing.
HD inline Aabb unite(const Aabb& a, const Aabb& b)
{
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

HD inline bool is_empty(const Aabb& box)
{
    return box.lower.x > box.upper.x || box.lower.y > box.upper.y || box.lower.z > box.upper.z;
}

HD inline bool is_finite(const Aabb& box)
{
    return is_finite(box.lower) && is_finite(box.upper);
}

/// Half the surface area of a box that is not empty.
HD inline float half_area(const Aabb& box)
{
    const Vec3 d = box.upper - box.lower;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

/// The middle. Halves before it adds: does not overflow.
HD inline Vec3 centroid(const Aabb& box)
{
    return 0.5f * box.lower + 0.5f * box.upper;
}

} // namespace fast
