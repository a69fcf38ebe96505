#pragma once

// The possible and the certain results of a ray in single precision against one primitive, from double
// precision and the bounds derived in intersect.h and sphere.h.

#include "cuda/trees/sphere.h"
#include "ref/trees/intersect.h"
#include "tests/cuda/trees/float_limits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fast_trees_test {

/// If there is a hit, then at lowest <= t <= highest; if `certain`, there must be one.
struct HitBounds {
    bool possible;
    bool certain;
    double lowest, highest;
    double margin = 0; // of a triangle: the error of its weights
};

inline ref::Ray exactly(const fast::Ray& ray)
{
    return {ref::Vec3(ray.origin), ref::Vec3(ray.direction), ray.t_max};
}

inline std::array<ref::Vec3, 3> exactly(const fast::Triangle& triangle)
{
    const auto& v = triangle.vertices;
    return {ref::Vec3(v[0]), ref::Vec3(v[1]), ref::Vec3(v[2])};
}

/// The position of 0 and t_max relative to [lowest, highest] decides the rest.
inline HitBounds settled(const fast::Ray& ray, bool certain, double lowest, double highest,
                         double margin = 0)
{
    return {highest > 0 && lowest < ray.t_max, certain && lowest > 0 && highest < ray.t_max, lowest,
            highest, margin};
}

constexpr HitBounds impossible{false, false, 0, 0, 0};

// The test in float uses vertices that are perturbed by at most 7 u D across the ray and 3 u D along
// it (see slabs.h), where D is the largest coordinate of v - o, and is exact for those. The reference
// does the same with a roundoff that is negligible here. So both agree where the ray passes the edges
// at a greater distance, which in barycentric coordinates is 7 u D / height; the factor 4 accounts for
// the movement of both ends of an edge, and of the third vertex. With `slack`, the ray that was really
// traced began within that distance of this ray's origin, and passed within that distance of this ray.
// Across the ray this is 3 slack after the shear, whose factors are at most 1. Along it, it is 2 slack
// over the length of the direction, whose largest component is 0.57 of the length.
inline HitBounds hit_bounds(const fast::Ray& ray, const fast::Triangle& triangle, double slack = 0)
{
    const ref::Ray exact = exactly(ray);
    const auto v = exactly(triangle);
    const ref::ShearedRay sheared(exact);
    const ref::Vec3 A = sheared.shear(v[0]);
    const ref::Vec3 B = sheared.shear(v[1]);
    const ref::Vec3 C = sheared.shear(v[2]);
    const double U = C.x * B.y - C.y * B.x;
    const double V = A.x * C.y - A.y * C.x;
    const double W = B.x * A.y - B.y * A.x;
    const double det = U + V + W;
    const double inside = std::min({U / det, V / det, W / det});
    double D = 0;
    for (const ref::Vec3& vertex : v)
        for (int axis = 0; axis < 3; ++axis)
            D = std::max(D, std::abs(vertex[axis] - exact.origin[axis]));
    const double edge = std::max({std::hypot(B.x - A.x, B.y - A.y), std::hypot(C.x - A.x, C.y - A.y),
                                  std::hypot(C.x - B.x, C.y - B.y)});
    const double margin = 4 * (7 * u * D + 3 * slack) * edge / std::abs(det);
    if (!(margin <= 0.1)) return settled(ray, false, -infinity, infinity);
    if (inside < -margin) return impossible;
    // An error of `margin` in the weights changes t by at most the spread of the vertices' own t,
    // which have an error of 3 u; and t is rounded.
    const double t = (U * A.z + V * B.z + W * C.z) / det;
    const double spread = std::max({A.z, B.z, C.z}) - std::min({A.z, B.z, C.z});
    const double farthest = std::max({std::abs(A.z), std::abs(B.z), std::abs(C.z)});
    const double t_margin =
        3 * margin * spread + 5 * u * farthest + 2 * slack / glm::length(exact.direction);
    return settled(ray, inside > margin, t - t_margin, t + t_margin, margin);
}

// A reported hit is within 22 u M of the sphere (see sphere.h): it is a hit of a sphere that is larger
// or smaller by that. Whether the origin is inside must be certain by the same margin. `slack` as
// above: the sphere may be displaced by that distance.
inline HitBounds hit_bounds(const fast::Ray& ray, const fast::Sphere& sphere, double slack = 0)
{
    const ref::Ray exact = exactly(ray);
    const ref::Vec3 f = exact.origin - ref::Vec3(sphere.center);
    const double r = sphere.radius;
    const double F = glm::length(f);
    const double speed = glm::length(exact.direction);
    const double middle = -glm::dot(f, exact.direction) / (speed * speed);
    const double l = glm::length(f + middle * exact.direction);
    const double bound = 22 * 0x1p-24 * std::max(F, 2 * r) + slack;
    if (l > r + bound) return impossible;
    const auto half_chord = [&](double radius) {
        return radius > l ? std::sqrt((radius - l) * (radius + l)) / speed : 0.0;
    };
    const double longest = half_chord(r + bound);
    const double shortest = half_chord(r - bound);
    const bool clear = l < r - bound;
    if (F > r + bound) // outside: the nearer hit, if it is in front
        return settled(ray, clear, middle - longest, clear ? middle - shortest : middle + longest);
    if (F < r - bound) return settled(ray, true, middle + shortest, middle + longest);
    return settled(ray, false, middle - longest, middle + longest);
}

} // namespace fast_trees_test
