#pragma once

// The intersection of a ray with a triangle, watertight in single precision [Woop, Benthin, Wald
// 2013].
//
// Names follow the paper: kx, ky, kz, S, A, B, C, U, V, W, T, det.

#include "cuda/parallel/number.h"
#include "cuda/trees/centroid_bounds.h"
#include "cuda/trees/ray.h"

namespace fast {

/// What ShearedRay is made of.
template <class F>
struct ShearOf {
    WordOf<F> kz;
    Vec3Of<F> origin;  // permuted: its coordinates kx, ky, kz
    Vec3Of<F> factors; // S
};

/// A ray with the transformation that turns it into the z axis: kz is the coordinate along which the
/// direction is longest, and S holds the factors that shear and scale the others [Woop et al. 2013,
/// sec. 3.1].
class ShearedRay {
public:
    HD explicit ShearedRay(const Ray& ray)
    {
        // No branches: half of them would be predicted wrongly.
        const Vec3 length = magnitude_of(ray.direction);
        const int x_or_y = length.x > length.y ? 0 : 1;
        const int z_is_longest = greater(length.x, length.y) > length.z ? 0 : 1;
        set_kz(x_or_y + z_is_longest * (2 - x_or_y));
        origin_ = permuted(ray.origin);
        const Vec3 d = permuted(ray.direction);
        shear_ = Vec3(d.x, d.y, 1.0f) / d.z;
    }
    HD explicit ShearedRay(const ShearOf<float>& shear) : origin_(shear.origin), shear_(shear.factors)
    {
        set_kz(static_cast<int>(shear.kz));
    }
    /// x and y across the ray; z is the t at which the ray is level with the vertex. A vertex is moved
    /// to the same place for every triangle that it belongs to, so no gap opens between them.
    [[nodiscard]] HD Vec3 shear(const Vec3& vertex) const
    {
        const Vec3 moved = permuted(vertex) - origin_;
        // map: triangle-shear
        return {moved.x - shear_.x * moved.z, moved.y - shear_.y * moved.z, shear_.z * moved.z};
    }
    [[nodiscard]] HD int kx() const { return kx_; }
    [[nodiscard]] HD int ky() const { return ky_; }
    [[nodiscard]] HD int kz() const { return kz_; }
    [[nodiscard]] HD const Vec3& origin() const { return origin_; } // permuted: x is the coordinate kx
    [[nodiscard]] HD const Vec3& shear_factors() const { return shear_; } // S

private:
    HD void set_kz(int kz)
    {
        kx_ = next_axis(kz);
        ky_ = next_axis(kx_);
        kz_ = kz;
    }
    [[nodiscard]] HD Vec3 permuted(const Vec3& v) const
    {
        return {coordinate(v, kx_), coordinate(v, ky_), coordinate(v, kz_)};
    }

    int kx_, ky_, kz_;
    Vec3 origin_; // permuted
    Vec3 shear_;
};

/// px qy - py qx: the products are exact in double, and the difference is rounded once. So its sign is
/// that of the exact value.
HD inline double edge_in_double(const Vec3& p, const Vec3& q)
{
    return static_cast<double>(p.x) * q.y - static_cast<double>(p.y) * q.x;
}

/// The same, in double only if needed for the sign: rounding never reverses the order of two products,
/// it can only make them equal [Woop et al. 2013, sec. 3.3].
HD inline float edge_sign(const Vec3& p, const Vec3& q)
{
    const float difference = p.x * q.y - p.y * q.x; // map: triangle-edges
    return difference != 0 ? difference : static_cast<float>(edge_in_double(p, q));
}

/// If the ray hits the triangle at 0 < t < `limit`: sets `t`, `b1`, `b2`. Edges and corners belong to
/// the triangle, and it can be hit from both sides. A triangle seen exactly edge-on is not hit. The
/// test is exact, except that the sheared vertices and the three results are rounded.
HD inline bool intersect_triangle(const ShearedRay& ray, const Triangle& triangle, float limit, Hit& hit)
{
    const Vec3 A = ray.shear(triangle.vertices[0]);
    const Vec3 B = ray.shear(triangle.vertices[1]);
    const Vec3 C = ray.shear(triangle.vertices[2]);
    const float u = edge_sign(C, B);
    const float v = edge_sign(A, C);
    const float w = edge_sign(B, A);
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;

    // Inside. A sliver needs its weights to full precision, not only their signs.
    const double U = edge_in_double(C, B);
    const double V = edge_in_double(A, C);
    const double W = edge_in_double(B, A);
    const double det = U + V + W; // all of one sign: 0 only if all are 0
    if (det == 0) return false;
    const double T = U * A.z + V * B.z + W * C.z;
    if ((T < 0) != (det < 0)) return false;     // behind the ray, like a surface that it has just left
    const auto t = static_cast<float>(T / det); // map: triangle-distance
    if (!(t > 0 && t < limit)) return false;
    hit.t = t;
    hit.b1 = static_cast<float>(V / det);
    hit.b2 = static_cast<float>(W / det);
    return true;
}

} // namespace fast
