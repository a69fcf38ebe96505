#pragma once

// The box around the centroids of all primitives, which is the grid of their Morton codes, and the first
// primitive whose box is not legal.

#include "cuda/trees/aabb.h"

#include <cstdint>
#include <span>

namespace fast {

constexpr std::uint32_t no_primitive = 0xffff'ffff;

struct CentroidBounds {
    Aabb box;                     // around all centroids
    std::uint32_t first_rejected; // lowest number of a primitive whose box is not legal, or no_primitive
};

HD inline CentroidBounds empty_centroid_bounds()
{
    return {empty_aabb(), no_primitive};
}

/// Function object of one primitive. A box that is empty or has a coordinate that is NaN or infinite is
/// not legal: it does not enter the bounds, so the other primitives get the same grid as without it, and
/// the build need not wait until the input has been checked.
struct BoundCentroid {
    std::span<const Aabb> boxes;

    HD CentroidBounds operator()(std::uint32_t i) const
    {
        const Aabb& box = boxes[i];
        if (is_empty(box) || !is_finite(box)) return {empty_aabb(), i};
        const Vec3 middle = centroid(box);
        return {{middle, middle}, no_primitive};
    }
};

struct UniteCentroidBounds {
    HD CentroidBounds operator()(const CentroidBounds& a, const CentroidBounds& b) const
    {
        return {unite(a.box, b.box),
                a.first_rejected < b.first_rejected ? a.first_rejected : b.first_rejected};
    }
};

} // namespace fast
