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
struct Sphere {
    Vec3 center;
    float radius;
};

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
/// smallest such t, and the weights to 0. Squares of lengths must be within the range of floats.
///
/// The textbook's discriminant b^2 - a c loses all digits for a small or distant sphere. So it is
/// computed as r^2 - |l|^2, where l points from the centre to the nearest point of the ray's line. Of
/// the two roots of a t^2 - 2 b t + c, the one that would suffer from cancellation is computed from
/// their product c / a.
HD inline bool intersect_sphere(const Ray& ray, const Sphere& sphere, float limit, Hit& hit)
{
    const Vec3 f = ray.origin - sphere.center;
    const float a = glm::dot(ray.direction, ray.direction);
    const float b = -glm::dot(f, ray.direction);
    const Vec3 l = f + (b / a) * ray.direction;
    const float r2 = sphere.radius * sphere.radius;
    const float discriminant = r2 - glm::dot(l, l);
    if (!(discriminant >= 0)) return false;
    const float c = glm::dot(f, f) - r2;
    // Two separate roots: the product of their arguments would be the fourth power of a length.
    const float root = std::sqrt(a) * std::sqrt(discriminant);
    const float q = b < 0 ? b - root : b + root;
    const float t0 = c / q;
    const float t1 = q / a;
    const float near = t0 < t1 ? t0 : t1;
    const float far = t0 < t1 ? t1 : t0;
    const float t = near > 0 ? near : far;
    if (!(t > 0 && t < limit)) return false;
    hit.t = t;
    hit.b1 = 0;
    hit.b2 = 0;
    return true;
}

} // namespace fast
