#pragma once

// What a ray in single precision may and must answer about one primitive, from double precision and the
// bounds that intersect.h and sphere.h derive.

#include "cuda/trees/sphere.h"
#include "ref/trees/intersect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cuda_test {

/// If it is hit at all, then at lowest <= t <= highest; if `certain`, it is.
struct Verdict {
    bool possible;
    bool certain;
    double lowest, highest;
    double margin = 0; // of a triangle: by how much its weights may differ
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

/// Where 0 and t_max stand to [lowest, highest] settles the rest.
inline Verdict settled(const fast::Ray& ray, bool certain, double lowest, double highest,
                       double margin = 0)
{
    return {highest > 0 && lowest < ray.t_max, certain && lowest > 0 && highest < ray.t_max, lowest,
            highest, margin};
}

constexpr Verdict impossible{false, false, 0, 0, 0};

// The float test sees vertices that are perturbed by at most 7 u D across the ray and 3 u D along it
// (see slabs.h), D the largest coordinate of v - o, and is exact for those. The reference does the same
// with a roundoff that does not count here. So they agree where the ray passes the edges at a greater
// distance, in barycentric terms 7 u D / height; the factor 4 covers that both ends of an edge move, and
// the third vertex. With `slack`, the ray that was really traced began within so short a distance of
// this one's origin and passed within that distance of it: across it that is 3 slack after the shear,
// whose factors are at most 1, and along it 2 slack over the length of the direction, the largest
// component of which is 0.57 of it.
inline Verdict verdict(const fast::Ray& ray, const fast::Triangle& triangle, double slack = 0)
{
    constexpr double u = 0x1p-24;
    constexpr double infinity = std::numeric_limits<double>::infinity();
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
    // A change of the weights by `margin` changes t by at most the spread of the vertices' own t,
    // which are themselves off by 3 u; and t is rounded.
    const double t = (U * A.z + V * B.z + W * C.z) / det;
    const double spread = std::max({A.z, B.z, C.z}) - std::min({A.z, B.z, C.z});
    const double farthest = std::max({std::abs(A.z), std::abs(B.z), std::abs(C.z)});
    const double t_margin =
        3 * margin * spread + 5 * u * farthest + 2 * slack / glm::length(exact.direction);
    return settled(ray, inside > margin, t - t_margin, t + t_margin, margin);
}

// What is found is within 22 u M of the sphere (see sphere.h): it is a hit of one that is larger or
// smaller by so much. Whether the origin is inside must be as clear. `slack` as above: the sphere might
// as well be elsewhere by so much.
inline Verdict verdict(const fast::Ray& ray, const fast::Sphere& sphere, double slack = 0)
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
    if (F > r + bound) // outside: the nearer one, if it lies ahead
        return settled(ray, clear, middle - longest, clear ? middle - shortest : middle + longest);
    if (F < r - bound) return settled(ray, true, middle + shortest, middle + longest);
    return settled(ray, false, middle - longest, middle + longest);
}

} // namespace cuda_test
