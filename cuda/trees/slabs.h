#pragma once

// The intersection of a ray with boxes, as three pairs of planes [Kay and Kajiya 1986].
//
// The test must not miss a box around a triangle that intersect.h would hit, nor a box around a sphere
// that would be hit. Let u = 2^-24 be the unit roundoff, o the origin of the ray, and m the largest
// coordinate of b - o over the corners b of the root's box. The shear moves a vertex by at most 7 u m
// across the ray and 3 u m along it (two differences, two quotients, one product), and t is rounded
// once. A reported hit of a sphere is within 22 u M of it (sphere.h), where M <= 2 m: the radius is at
// most m, and the distance of the centre at most sqrt(3) m. Here the difference, the reciprocal and
// the product are rounded once each. The sum of all these errors stays below 64 u m along every axis.
// Every box is padded by 64 u m, so no comparison needs a tolerance. [Ize 2013] treats the error of
// the boxes alone.
//
// The padding is not added to the planes but subtracted from the origin, once for the planes at which
// the ray enters and once for those at which it leaves. That sum is rounded by u |o + padding|, so
// that 2 u |o| more is subtracted.

#include "cuda/trees/ray.h"
#include "cuda/trees/rounding.h"
#include "cuda/trees/wide_node.h"

#include <cstddef>
#include <limits>

namespace fast {

class Slabs {
public:
    HD Slabs(const Ray& ray, const Aabb& root)
        : reciprocal_(1.0f / ray.direction.x, 1.0f / ray.direction.y, 1.0f / ray.direction.z)
    {
        const Vec3 reach =
            glm::max(glm::abs(root.lower - ray.origin), glm::abs(root.upper - ray.origin));
        const float m = glm::max(glm::max(reach.x, reach.y), reach.z);
        for (int axis = 0; axis < 3; ++axis) {
            const float origin = ray.origin[axis];
            const float padding = unit_roundoff * (64 * m + 2 * glm::abs(origin));
            // 1 / -0 is minus infinity: a ray with direction -0 counts as descending.
            const bool descends = reciprocal_[axis] < 0;
            first_[axis] = descends ? 1 : 0;
            entering_[axis] = descends ? origin - padding : origin + padding;
            leaving_[axis] = descends ? origin + padding : origin - padding;
        }
    }
    /// The smallest t >= 0 at which the ray is in the box; infinity if there is no such t <= limit.
    [[nodiscard]] HD float entry(const Aabb& box, float limit) const
    {
        float near = 0;
        float far = limit;
        clip(box, 0, near, far);
        clip(box, 1, near, far);
        clip(box, 2, near, far);
        return near <= far ? near : std::numeric_limits<float>::infinity();
    }

private:
    friend class WideSlabs;

    HD void clip(const Aabb& box, int axis, float& near, float& far) const
    {
        const bool descends = first_[axis] != 0;
        const float enter =
            ((descends ? box.upper : box.lower)[axis] - entering_[axis]) * reciprocal_[axis];
        const float leave =
            ((descends ? box.lower : box.upper)[axis] - leaving_[axis]) * reciprocal_[axis];
        // In the plane of a face 0 * infinity is NaN, which these comparisons ignore.
        near = enter > near ? enter : near;
        far = leave < far ? leave : far;
    }

    Vec3 reciprocal_;
    int first_[3];  // 1 where the ray descends: it enters a box by the upper plane
    Vec3 entering_; // the origin, less the padding, for planes at which the ray enters
    Vec3 leaving_;
};

/// The same for all boxes of a wide node at once.
class WideSlabs {
public:
    HD explicit WideSlabs(const Slabs& slabs)
    {
        for (int axis = 0; axis < 3; ++axis) {
            const auto lower = static_cast<std::size_t>(axis);
            const std::size_t upper = 3 + lower;
            first_[axis] = slabs.first_[axis] != 0 ? upper : lower;
            last_[axis] = slabs.first_[axis] != 0 ? lower : upper;
            entering_[axis] = all_lanes(slabs.entering_[axis]);
            leaving_[axis] = all_lanes(slabs.leaving_[axis]);
            reciprocal_[axis] = all_lanes(slabs.reciprocal_[axis]);
        }
    }
    /// The boxes that the ray is in at a t from 0 to `limit`; `near`: the smallest such t of each.
    [[nodiscard]] HD LaneBits entered(const WideNode& node, float limit, Lanes& near) const
    {
        // In the plane of a face 0 * infinity is NaN. Then the second argument is taken, and the worst
        // effect is a visit to a box that could have been skipped.
        near = larger(larger(enter(node, 0), enter(node, 1)), larger(enter(node, 2), all_lanes(0)));
        const Lanes far =
            smaller(smaller(leave(node, 0), leave(node, 1)), smaller(leave(node, 2), all_lanes(limit)));
        return not_above(near, far);
    }

private:
    [[nodiscard]] HD Lanes enter(const WideNode& node, int axis) const
    {
        return (node.planes[first_[axis]] - entering_[axis]) * reciprocal_[axis];
    }
    [[nodiscard]] HD Lanes leave(const WideNode& node, int axis) const
    {
        return (node.planes[last_[axis]] - leaving_[axis]) * reciprocal_[axis];
    }

    std::size_t first_[3]; // the plane by which the ray enters a box
    std::size_t last_[3];
    Lanes entering_[3];
    Lanes leaving_[3];
    Lanes reciprocal_[3];
};

} // namespace fast
