#pragma once

// Axis-aligned boxes.

#include "scenes/scene.h"

#include <glm/common.hpp>

#include <cmath>
#include <limits>

namespace ref {

using scenes::Vec3;

/// The box of all points between two corners, faces included. The default is the empty box, which is
/// the neutral element of `unite`.
struct Aabb {
    Vec3 lower = Vec3(std::numeric_limits<double>::infinity());
    Vec3 upper = Vec3(-std::numeric_limits<double>::infinity());
    friend bool operator==(const Aabb&, const Aabb&) = default;
};

/// The smallest box around both. Nothing is rounded: every coordinate of the result is a coordinate of
/// `a` or of `b`.
inline Aabb unite(const Aabb& a, const Aabb& b)
{
    return {glm::min(a.lower, b.lower), glm::max(a.upper, b.upper)};
}

inline Aabb intersection(const Aabb& a, const Aabb& b)
{
    return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
}

inline bool is_empty(const Aabb& box)
{
    return box.lower.x > box.upper.x || box.lower.y > box.upper.y || box.lower.z > box.upper.z;
}

/// Half the surface area; 0 for an empty box. The factor of 2 cancels in all ratios of areas.
inline double half_area(const Aabb& box)
{
    if (is_empty(box)) return 0;
    const Vec3 d = box.upper - box.lower;
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

/// The centre of the box. Each corner is halved before the addition, so the sum cannot overflow.
inline Vec3 centroid(const Aabb& box)
{
    return 0.5 * box.lower + 0.5 * box.upper;
}

inline bool is_finite(const Vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace ref
