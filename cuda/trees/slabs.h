#pragma once

// A ray against boxes, as three pairs of planes [Kay and Kajiya 1986].
//
// The test must not miss a box around a triangle that intersect.h would hit, nor one around a sphere.
// Let u = 2^-24 be the unit roundoff and m the largest coordinate of b - o over the corners b of the
// root's box, o the origin of the ray. The shear moves a vertex by no more than 7 u m across the ray and
// 3 u m along it (two differences, two quotients, one product on the way), and t is rounded once. What
// counts as a hit of a sphere is within 22 u M of it (sphere.h), where M <= 2 m: the radius is m at
// most, and the distance of the centre sqrt(3) m. Here the difference b - o, its padding, the reciprocal
// and the product round once each. All of it together stays below 64 u m along every axis, by which
// every box is padded; so no comparison needs a tolerance. [Ize 2013] is about the boxes alone.

#include "cuda/trees/ray.h"
#include "cuda/trees/wide_node.h"

#include <limits>

namespace gpu {

class Slabs {
public:
    HD Slabs(const Ray& ray, const Box& root)
        : origin_(ray.origin),
          reciprocal_(1.0f / ray.direction.x, 1.0f / ray.direction.y, 1.0f / ray.direction.z)
    {
        const Vec3 reach = glm::max(glm::abs(root.lower - origin_), glm::abs(root.upper - origin_));
        const float m = glm::max(glm::max(reach.x, reach.y), reach.z);
        const float padding = 64 * (std::numeric_limits<float>::epsilon() / 2) * m;
        // Of -0 the reciprocal is minus infinity: such a ray descends.
        padding_ = Vec3(reciprocal_.x < 0 ? -padding : padding, reciprocal_.y < 0 ? -padding : padding,
                        reciprocal_.z < 0 ? -padding : padding);
    }
    HD Slabs(const Ray& ray, const WideNode& root) : Slabs(ray, bounds(root)) {}
    /// The smallest t >= 0 at which the ray is in the box; infinity if it is in it at no t <= limit.
    [[nodiscard]] HD float entry(const Box& box, float limit) const
    {
        float near = 0;
        float far = limit;
        clip(box.lower.x, box.upper.x, origin_.x, reciprocal_.x, padding_.x, near, far);
        clip(box.lower.y, box.upper.y, origin_.y, reciprocal_.y, padding_.y, near, far);
        clip(box.lower.z, box.upper.z, origin_.z, reciprocal_.z, padding_.z, near, far);
        return near <= far ? near : std::numeric_limits<float>::infinity();
    }

    /// The same for the four boxes of a wide node: the ray is in one from `near` to `far`, if that is
    /// not before.
    HD void entries(const WideNode& node, float limit, Lanes& near, Lanes& far) const
    {
        near = all_lanes(0);
        far = all_lanes(limit);
        clip(node, 0, origin_.x, reciprocal_.x, padding_.x, near, far);
        clip(node, 1, origin_.y, reciprocal_.y, padding_.y, near, far);
        clip(node, 2, origin_.z, reciprocal_.z, padding_.z, near, far);
    }

private:
    HD static Box bounds(const WideNode& node)
    {
        Box all = empty_box();
        for (int c = 0; c < 4; ++c)
            all = unite(all, {Vec3(node.bounds[0][0][c], node.bounds[0][1][c], node.bounds[0][2][c]),
                              Vec3(node.bounds[1][0][c], node.bounds[1][1][c], node.bounds[1][2][c])});
        return all;
    }
    HD static void clip(const WideNode& node, int axis, float origin, float reciprocal, float padding,
                        Lanes& near, Lanes& far)
    {
        const int first = reciprocal < 0 ? 1 : 0;
        const Lanes enter =
            (node.bounds[first][axis] - all_lanes(origin) - all_lanes(padding)) * all_lanes(reciprocal);
        const Lanes leave = (node.bounds[1 - first][axis] - all_lanes(origin) + all_lanes(padding)) *
                            all_lanes(reciprocal);
        near = larger(enter, near);
        far = smaller(leave, far);
    }
    HD static void clip(float lower, float upper, float origin, float reciprocal, float padding,
                        float& near, float& far)
    {
        const bool descends = reciprocal < 0;
        const float enter = ((descends ? upper : lower) - origin - padding) * reciprocal;
        const float leave = ((descends ? lower : upper) - origin + padding) * reciprocal;
        // In the very plane of a face 0 * infinity is NaN, and these comparisons pass it over.
        near = enter > near ? enter : near;
        far = leave < far ? leave : far;
    }

    Vec3 origin_;
    Vec3 reciprocal_;
    Vec3 padding_;
};

} // namespace gpu
