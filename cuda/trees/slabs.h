#pragma once

// The intersection of a ray with boxes, as three pairs of planes [Kay and Kajiya 1986].
//
// The test must not miss a box around a triangle that intersect.h would hit, nor a box around a sphere
// that would be hit. Let u = 2^-24 be the unit roundoff, o the origin of the ray, and m the largest
// coordinate of b - o over the corners b of the root's box. The shear moves a vertex by at most 7 u m
// across the ray and 3 u m along it (two differences, two quotients, one product), and t is rounded
// once. A reported hit of a sphere is within 22 u M of it (sphere.h), where M <= 2 m: the radius is at
// most m, and the distance of the centre at most sqrt(3) m.
//
// Every box is padded by p, so no comparison needs a tolerance. [Ize 2013] treats the error of the boxes
// alone. The padding is not added to the planes but to the origin: o' = o + p for planes at which the
// ray enters, o - p for those at which it leaves, as the ray ascends. With r = 1 / d and c = -o' r, the
// plane x is met at t = x r + c: one fused operation, where the processor has it. Multiplied by d, the
// rounding of o' changes t by u |o'|, of r by u |x - o'|, of c by u |o'|, of the product x r, where it
// is not fused, by u |x| <= u (|o'| + |x - o'|), and of the sum by u |x - o'|: together 3 u |o'| + 3 u
// m. With the errors above this stays below p = 64 u m + 4 u |o|.
//
// A coordinate of the direction that is 0 has no reciprocal. It counts as 2^-60 of the largest
// coordinate, as do smaller ones: over the reach of the ray this moves it by less than 2^-58 m. If a
// product may still overflow, the planes across that axis exclude no box, except the one that stands
// for a child that is absent: its planes are at infinity, and x r + c is the same infinity, never NaN.

#include "cuda/parallel/number.h"
#include "cuda/trees/ray.h"
#include "cuda/trees/rounding.h"
#include "cuda/trees/wide_node.h"

#include <cstddef>
#include <limits>

namespace fast {

/// A ray as the tests of boxes need it.
template <class F>
struct SlabRayOf {
    Vec3Of<F> reciprocal; // r; where it is negative, the ray enters a box by the upper plane
    Vec3Of<F> entering;   // c of planes at which the ray enters
    Vec3Of<F> leaving;

    SlabRayOf() = default; // undefined
    /// `root`: the box of the root.
    HD SlabRayOf(const RayOf<F>& ray, const Aabb& root)
    {
        const Vec3Of<F> below = magnitude_of(Vec3Of<F>(root.lower) - ray.origin);
        const Vec3Of<F> above = magnitude_of(Vec3Of<F>(root.upper) - ray.origin);
        F m = 0.0f;
        F longest = 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            m = greater(m, greater(below[axis], above[axis]));
            longest = greater(longest, magnitude_of(ray.direction[axis]));
        }
        for (int axis = 0; axis < 3; ++axis) {
            const F& o = ray.origin[axis];
            const F p = unit_roundoff * (64.0f * m + 4.0f * magnitude_of(o));
            // The sign of p, not a choice: for a single ray that would be a branch, half of the time
            // predicted wrongly.
            const F outwards = with_sign_of(p, ray.direction[axis]);
            const F d = greater(magnitude_of(ray.direction[axis]), 0x1p-60f * longest);
            const F size = 1.0f / d;
            const F r = with_sign_of(size, ray.direction[axis]);
            // Of a direction below 2^-127 the reciprocal is infinite, and this product infinite or NaN.
            const MaskOf<F> in_range = (2.0f * magnitude_of(o) + m + p) * size <= largest;
            reciprocal[axis] = select(in_range, r, F(std::numeric_limits<float>::min()));
            entering[axis] = select(in_range, -(o + outwards) * r, F(-largest));
            leaving[axis] = select(in_range, -(o - outwards) * r, F(largest));
        }
    }

private:
    static constexpr float largest = std::numeric_limits<float>::max() / 2;
};
using SlabRay = SlabRayOf<float>;

/// The test of rays against one box, ray by ray.
template <class F>
class SlabsOf {
public:
    HD explicit SlabsOf(const SlabRayOf<F>& rays) : rays_(rays)
    {
        for (int axis = 0; axis < 3; ++axis) descends_[axis] = rays.reciprocal[axis] < 0.0f;
    }
    /// Where the rays are in the box at a t from 0 to `limit`; `near`: the smallest such t.
    [[nodiscard]] HD MaskOf<F> entered(const Aabb& box, const F& limit, F& near) const
    {
        near = 0.0f;
        F far = limit;
        for (int axis = 0; axis < 3; ++axis) {
            const F lower(box.lower[axis]);
            const F upper(box.upper[axis]);
            const F enter = multiply_add(select(descends_[axis], upper, lower), rays_.reciprocal[axis],
                                         rays_.entering[axis]);
            const F leave = multiply_add(select(descends_[axis], lower, upper), rays_.reciprocal[axis],
                                         rays_.leaving[axis]);
            // These comparisons ignore NaN.
            near = greater(near, enter);
            far = lesser(far, leave);
        }
        return near <= far; // map: slabs
    }

private:
    SlabRayOf<F> rays_;
    MaskOf<F> descends_[3];
};

/// The test of one ray against many boxes at once. `enter`, `leave`: where it meets the planes of each
/// axis by which it enters and leaves the boxes. Returns the boxes that the ray is in at a t from 0 to
/// `limit`; `near`: the smallest such t of each.
HD inline LaneBits boxes_entered(const Lanes (&enter)[3], const Lanes (&leave)[3], float limit,
                                 Lanes& near)
{
    // If the first argument is NaN, the second is taken: then the worst effect is a visit to a box that
    // could have been skipped.
    near = larger(larger(enter[0], enter[1]), larger(enter[2], all_lanes(0)));
    const Lanes far = smaller(smaller(leave[0], leave[1]), smaller(leave[2], all_lanes(limit)));
    return not_above(near, far); // map: slabs
}

/// The test of one ray against all boxes of a wide node at once.
class WideSlabs {
public:
    HD explicit WideSlabs(const SlabRay& ray)
    {
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t descends = ray.reciprocal[axis] < 0 ? 1 : 0;
            first_[axis] = static_cast<std::size_t>(axis) + 3 * descends;
            last_[axis] = static_cast<std::size_t>(axis) + 3 * (1 - descends);
            entering_[axis] = all_lanes(ray.entering[axis]);
            leaving_[axis] = all_lanes(ray.leaving[axis]);
            reciprocal_[axis] = all_lanes(ray.reciprocal[axis]);
        }
    }
    /// The boxes that the ray is in at a t from 0 to `limit`; `near`: the smallest such t of each.
    [[nodiscard]] HD LaneBits entered(const WideNode& node, float limit, Lanes& near) const
    {
        return boxes_entered({enter(node, 0), enter(node, 1), enter(node, 2)},
                             {leave(node, 0), leave(node, 1), leave(node, 2)}, limit, near);
    }

private:
    [[nodiscard]] HD Lanes enter(const WideNode& node, int axis) const
    {
        return multiply_add(node.planes[first_[axis]], reciprocal_[axis], entering_[axis]);
    }
    [[nodiscard]] HD Lanes leave(const WideNode& node, int axis) const
    {
        return multiply_add(node.planes[last_[axis]], reciprocal_[axis], leaving_[axis]);
    }

    std::size_t first_[3]; // the plane by which the ray enters a box
    std::size_t last_[3];
    Lanes entering_[3];
    Lanes leaving_[3];
    Lanes reciprocal_[3];
};

} // namespace fast
