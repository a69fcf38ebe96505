#pragma once

// The intersection of a ray with one triangle or one sphere. No constant here has a unit: scaling a
// scene by a power of two scales every t by it, bit for bit, as long as no product of three lengths
// overflows or underflows.
//
// Triangles: [Woop, Benthin, Wald 2013]. Names follow the paper: kx, ky, kz, S, A, B, C, U, V, W, T,
// det. Spheres: [Haines, Guenther, Akenine-Moeller 2019].

#include "ref/trees/ray.h"
#include "ref/trees/rounding.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace ref {

/// A ray prepared for the triangle test: the axis z along which its direction is longest, and the
/// shear that turns the ray into the z axis [Woop et al. 2013, sec. 3.1].
struct ShearedRay {
    explicit ShearedRay(const Ray& ray) : origin(ray.origin), t_max(ray.t_max)
    {
        const Vec3 d = ray.direction;
        const Vec3 length = glm::abs(d);
        kz = length.x > length.y ? (length.x > length.z ? 0 : 2) : (length.y > length.z ? 1 : 2);
        kx = (kz + 1) % 3;
        ky = (kz + 2) % 3;
        const double* const axis = glm::value_ptr(d);
        S = Vec3(axis[kx] / axis[kz], axis[ky] / axis[kz], 1 / axis[kz]);
    }

    /// `vertex` relative to the ray: x and y across the ray, z the value of t at which the ray is
    /// level with the vertex.
    [[nodiscard]] Vec3 shear(const Vec3& vertex) const
    {
        const Vec3 moved = vertex - origin;
        const double* const axis = glm::value_ptr(moved);
        // map: triangle-shear
        return {axis[kx] - S.x * axis[kz], axis[ky] - S.y * axis[kz], S.z * axis[kz]};
    }

    Vec3 origin;
    double t_max;
    int kx, ky, kz;
    Vec3 S;
};

struct TriangleHit {
    double t;
    Vec3 barycentric;
};

/// px qy - py qx, correct to two units of roundoff even under cancellation: Kahan's determinant, with
/// the rounding errors of both products, which fma gives exactly [Jeannerod, Louvet, Muller 2013].
inline double accurate_edge_function(const Vec3& p, const Vec3& q)
{
    const double right = p.y * q.x;
    const double error_of_right = std::fma(p.y, q.x, -right);
    return std::fma(p.x, q.y, -right) - error_of_right;
}

/// px qy - py qx: tells on which side of the line from `q` to `p` the ray passes. The sign is exact.
///
/// Rounding is monotonic: if one exact product is larger, its rounded value is not smaller. So a
/// difference of rounded products that is not 0 has the right sign; where it is 0, the accurate
/// difference decides. (With single precision, this step is computed again in double [Woop et al.
/// 2013, sec. 3.3]; here there is no wider type.) The two triangles at a shared edge get opposite
/// signs, so no ray passes between them.
inline double edge_function(const Vec3& p, const Vec3& q)
{
    const double difference = p.x * q.y - p.y * q.x; // map: triangle-edges
    return difference != 0 ? difference : accurate_edge_function(p, q);
}

/// Whether `limit` is certainly beyond the hit: U (a - limit) + V (b - limit) + W (c - limit) has the
/// opposite sign of U, V and W, even with all its rounding errors. `z` holds a, b, c: the t of the
/// vertices.
///
/// This is clear if all vertices are on one side of `limit`. Otherwise U carries 2 roundings, the
/// difference 1, the product 1 and the sum 2. The computed bound carries as many again, in total
/// gamma_12.
inline bool certainly_before(const Vec3& UVW, const Vec3& z, double limit)
{
    const Vec3 terms = UVW * (z - limit);
    const double size = std::abs(terms.x) + std::abs(terms.y) + std::abs(terms.z);
    const double sum = terms.x + terms.y + terms.z;
    const bool negative = UVW.x + UVW.y + UVW.z < 0;
    return (negative ? -sum : sum) < -gamma_bound(12) * size;
}

/// Watertight: edges and corners belong to the triangle, decided by the exact signs of U, V, W. The
/// ray may come from either side. A hit is reported only if 0 < t < t_max is certain in spite of
/// rounding: a ray that starts on one side of a plane, however close, does not hit it by going further
/// to that side (leave_surface in geometry.cpp relies on this). A triangle seen exactly edge-on is not
/// hit.
inline std::optional<TriangleHit> intersect_triangle(const ShearedRay& ray,
                                                     const std::array<Vec3, 3>& triangle)
{
    const Vec3 A = ray.shear(triangle[0]);
    const Vec3 B = ray.shear(triangle[1]);
    const Vec3 C = ray.shear(triangle[2]);
    const double U = edge_function(C, B);
    const double V = edge_function(A, C);
    const double W = edge_function(B, A);
    if (std::min({U, V, W}) < 0 && std::max({U, V, W}) > 0) return std::nullopt;

    // The ray passes inside. A sliver needs accurate weights, not only their signs.
    const Vec3 UVW(accurate_edge_function(C, B), accurate_edge_function(A, C),
                   accurate_edge_function(B, A));
    const double det = UVW.x + UVW.y + UVW.z; // no cancellation: det is 0 only if all three are 0
    const Vec3 z(A.z, B.z, C.z);
    if (det == 0 || !certainly_before(UVW, -z, 0)) return std::nullopt; // t > 0 is -t < 0
    if (std::isfinite(ray.t_max) && !certainly_before(UVW, z, ray.t_max)) return std::nullopt;

    const Vec3 barycentric = UVW / det;
    const double t = glm::dot(barycentric, z); // map: triangle-distance
    if (!(t > 0 && t < ray.t_max)) return std::nullopt;
    return TriangleHit{t, barycentric};
}

/// The smallest t with 0 < t < t_max at which the ray crosses the sphere's surface, from either side.
///
/// The textbook's discriminant b^2 - ac loses all digits for a small or distant sphere. Here it is r^2
/// - |l|^2, where l points from the centre to the nearest point of the ray's line. Of the two roots of
/// a t^2 - 2 b t + c, the one that would suffer from cancellation is computed from their product c /
/// a.
inline std::optional<double> intersect_sphere(const Ray& ray, const Vec3& center, double radius)
{
    const Vec3 f = ray.origin - center;
    const double a = glm::dot(ray.direction, ray.direction);
    const double b = -glm::dot(f, ray.direction);
    const Vec3 l = f + (b / a) * ray.direction;
    const double discriminant = radius * radius - glm::dot(l, l); // map: sphere-discriminant
    if (!(discriminant >= 0)) return std::nullopt;
    const double c = glm::dot(f, f) - radius * radius;
    // Two separate roots: the product of their arguments would have four lengths as factors, and could
    // overflow.
    // map: sphere-distance
    const double q = b + std::copysign(std::sqrt(a) * std::sqrt(discriminant), b);
    const double t0 = c / q;
    const double t1 = q / a;
    const auto valid = [&](double t) { return t > 0 && t < ray.t_max; };
    const double near = std::min(t0, t1);
    const double far = std::max(t0, t1);
    if (valid(near)) return near;
    if (valid(far)) return far;
    return std::nullopt;
}

/// The same for a ray whose origin lies on the sphere: one root of a t^2 - 2 b t is 0, the other is 2
/// b / a.
inline std::optional<double> leave_sphere(const Ray& ray, const Vec3& center)
{
    const double a = glm::dot(ray.direction, ray.direction);
    const double t = 2 * (-glm::dot(ray.origin - center, ray.direction) / a);
    return t > 0 && t < ray.t_max ? std::optional(t) : std::nullopt;
}

} // namespace ref
