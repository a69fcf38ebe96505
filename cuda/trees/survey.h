#pragma once

// What must be known of all primitives before one of them can be placed: the box around their centroids,
// and whether one of them is none.

#include "cuda/trees/box.h"

#include <cstdint>
#include <span>

namespace gpu {

constexpr std::uint32_t no_primitive = 0xffff'ffff;

struct Survey {
    Box centroids;
    std::uint32_t first_rejected; // lowest number of a primitive that is no box, or no_primitive
};

HD inline Survey empty_survey()
{
    return {empty_box(), no_primitive};
}

/// Of a box that is empty or has a coordinate that is NaN or infinite, nothing is taken but its number:
/// the others get the grid that they would have without it, and nobody has to wait for the verdict.
struct SurveyBox {
    std::span<const Box> boxes;

    HD Survey operator()(std::uint32_t i) const
    {
        const Box& box = boxes[i];
        if (is_empty(box) || !is_finite(box)) return {empty_box(), i};
        const Vec3 middle = centroid(box);
        return {{middle, middle}, no_primitive};
    }
};

struct UniteSurveys {
    HD Survey operator()(const Survey& a, const Survey& b) const
    {
        return {unite(a.centroids, b.centroids),
                a.first_rejected < b.first_rejected ? a.first_rejected : b.first_rejected};
    }
};

} // namespace gpu
