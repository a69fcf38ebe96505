#pragma once

// Spheres, their boxes, and the intersection of a ray with a sphere [Haines, Guenther, Akenine-Moeller
// 2019].
//
// How far from the sphere can a reported hit be? Let u = 2^-24, f the vector from the centre c to the
// origin of the ray, F = |f|, and M the larger of F and 2 r. Lengths are measured along the ray. To
// first order in u:
// 1. f has an error of u F, as if c were moved.
// 2. b has an error of 3 u F |d| and a one of 3 u a, so b / a has one of 7 u F / |d|. This moves l
//    along d, at right angles to l itself, and changes the length of l only to second order. Product
//    and sum move l by 2 u F.
// 3. So r^2 - |l|^2 has an error of at most e = 5 u r^2 + 4 u F r (where it is negative, it is not
//    used).
// 4. q / |d| has an error of e_q = 8 u F + 10 u r: 3 u F from b, 5 u r from the root, 5 u (F + r) from
//    the operations that follow.
// 5. q / a is then a point whose distance from c has an error of at most e_q + e / (2 r) <= 17 u M.
// 6. c / q, the other point, solves the equation up to 2 r e_q + e + e_c. Here e_c = 4 u max(F, r)^2
//    is the error of |f|^2 - r^2, of which the fraction 2 r / (0.86 F) remains where F > 2 r. Divided
//    by 2 r, the slope of the equation at its root, the sum is at most 21 u M.
//
// Together with step 1, the reported point lies within 22 u M of the sphere. By step 3, a hit is not
// missed if the exact ray passes farther than that inside the silhouette.

#include "cuda/trees/ray.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace fast {

/// The points at `radius` >= 0 from `center`.
template <class F>
struct SphereOf {
    Vec3Of<F> center;
    F radius;
};
using Sphere = SphereOf<float>;

/// Kernel over spheres: their boxes, rounded outwards. A sphere that is not finite gets a box that is
/// not finite, and a negative radius gives an empty box; the tree build rejects both.
struct BoundSpheres {
    std::span<const Sphere> spheres;
    std::span<Aabb> boxes;

    HD void operator()(std::uint32_t i) const
    {
        const auto& [center, radius] = spheres[i];
        // 2 u |x| is at least one unit in the last place of x, which is more than the rounding of x.
        constexpr float ulp = std::numeric_limits<float>::epsilon();
        const Vec3 lower = center - radius;
        const Vec3 upper = center + radius;
        boxes[i] = {lower - ulp * glm::abs(lower), upper + ulp * glm::abs(upper)};
    }
};

/// If the ray crosses the sphere's surface, from either side, at 0 < t < `limit`: sets `t` to the
/// smallest such t; else to any number. Squares of lengths must be within the range of floats.
///
/// The textbook's discriminant b^2 - a c loses all digits for a small or distant sphere. So it is
/// computed as r^2 - |l|^2, where l points from the centre to the nearest point of the ray's line. Of
/// the two roots of a t^2 - 2 b t + c, the one that would suffer from cancellation is computed from
/// their product c / a.
template <class F>
HD MaskOf<F> intersect_sphere(const RayOf<F>& ray, const SphereOf<F>& sphere, const F& limit, F& t)
{
    const Vec3Of<F> f = ray.origin - sphere.center;
    const F a = glm::dot(ray.direction, ray.direction);
    const F b = -glm::dot(f, ray.direction);
    const Vec3Of<F> l = f + (b / a) * ray.direction;
    const F r2 = sphere.radius * sphere.radius;
    const F discriminant = r2 - glm::dot(l, l); // map: sphere-discriminant
    const MaskOf<F> crosses = discriminant >= 0.0f;
    if (none(crosses)) return crosses;
    const F c = glm::dot(f, f) - r2;
    // Two separate roots: the product of their arguments would be the fourth power of a length.
    const F root = square_root(a) * square_root(discriminant);
    const F q = select(b < 0.0f, b - root, b + root); // map: sphere-distance
    const F t0 = c / q;
    const F t1 = q / a;
    const MaskOf<F> in_order = t0 < t1;
    const F near = select(in_order, t0, t1);
    const F far = select(in_order, t1, t0);
    t = select(near > 0.0f, near, far);
    return crosses && t > 0.0f && t < limit;
}

/// The same as a hit, whose weights are 0.
HD inline bool intersect_sphere(const Ray& ray, const Sphere& sphere, float limit, Hit& hit)
{
    hit.b1 = 0;
    hit.b2 = 0;
    return intersect_sphere<float>(ray, sphere, limit, hit.t);
}

} // namespace fast
