#pragma once

// Spheres, their boxes, and a ray against one of them [Haines, Guenther, Akenine-Moeller 2019].
//
// How far from the sphere may the point lie that is reported as a hit? Let u = 2^-24, f from the centre
// c to the origin of the ray, F = |f|, M the larger of F and 2 r, and count lengths along the ray. To
// first order in u:
// 1. f errs by u F, as if c were elsewhere.
// 2. b by 3 u F |d| and a by 3 u a: b / a by 7 u F / |d|. That moves l along d, at right angles to l
// itself,
//    and changes its length to second order only. Product and sum move it by 2 u F.
// 3. So r^2 - |l|^2 errs by no more than e = 5 u r^2 + 4 u F r (it is not used where it is negative).
// 4. q / |d| errs by e_q = 8 u F + 10 u r: 3 u F from b, 5 u r from the root, 5 u (F + r) from what
// follows.
// 5. q / a then is a point at a distance from c that is wrong by e_q + e / (2 r) <= 17 u M.
// 6. c / q, the other one, solves the equation but for 2 r e_q + e + e_c, where e_c = 4 u max(F, r)^2 is
// the
//    error of |f|^2 - r^2; of that remains 2 r / 0.86 F where F > 2 r. Divided by 2 r, the slope of the
//    equation where it is 0, that is 21 u M at most.
// All together with step 1: the point lies within 22 u M of the sphere. A hit that the exact ray passes
// at a greater distance from the silhouette is not missed, by step 3.

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

/// Kernel over spheres: their boxes, rounded outwards. What is not finite gets a box that is not, and a
/// negative radius one that is empty: they will be rejected.
struct BoundSpheres {
    std::span<const Sphere> spheres;
    std::span<Aabb> boxes;

    HD void operator()(std::uint32_t i) const
    {
        const auto& [center, radius] = spheres[i];
        // Twice u |x| is a unit in the last place of x at least: more than rounding x took.
        constexpr float ulp = std::numeric_limits<float>::epsilon();
        const Vec3 lower = center - radius;
        const Vec3 upper = center + radius;
        boxes[i] = {lower - ulp * glm::abs(lower), upper + ulp * glm::abs(upper)};
    }
};

/// If the ray crosses the sphere's surface, from either side, at 0 < t < `limit`: sets `t` to the
/// smallest such t, and the weights to 0. Squares of lengths must be within the range of floats.
///
/// The textbook's discriminant b^2 - a c loses all digits of a small or distant sphere. So it is taken
/// as r^2 - |l|^2, l from the centre to the nearest point of the ray's line; and of the two roots of a
/// t^2 - 2 b t + c the one that would cancel comes from their product c / a.
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
    // Two roots of their own: the product of their arguments is the fourth power of a length.
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
