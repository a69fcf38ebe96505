#pragma once

// A ray against a triangle, watertight in single precision [Woop, Benthin, Wald 2013].
//
// Names follow the paper: kx, ky, kz, S, A, B, C, U, V, W, T, det.

#include "cuda/trees/centroid_bounds.h"
#include "cuda/trees/ray.h"

namespace fast {

/// A ray seen so that it is the z axis: kz is the coordinate along which it is longest, S what shears
/// and scales the others [Woop et al. 2013, sec. 3.1].
class ShearedRay {
public:
    HD explicit ShearedRay(const Ray& ray)
    {
        const Vec3 length = glm::abs(ray.direction);
        kz_ = length.x > length.y ? (length.x > length.z ? 0 : 2) : (length.y > length.z ? 1 : 2);
        kx_ = (kz_ + 1) % 3;
        ky_ = (kz_ + 2) % 3;
        origin_ = permuted(ray.origin);
        const Vec3 d = permuted(ray.direction);
        shear_ = Vec3(d.x, d.y, 1.0f) / d.z;
    }
    /// x and y across the ray; z is the t at which it is level with the vertex. The same vertex is moved
    /// to the same place for every triangle that it belongs to: so no gap opens between them.
    [[nodiscard]] HD Vec3 shear(const Vec3& vertex) const
    {
        const Vec3 moved = permuted(vertex) - origin_;
        return {moved.x - shear_.x * moved.z, moved.y - shear_.y * moved.z, shear_.z * moved.z};
    }
    [[nodiscard]] HD int kx() const { return kx_; }
    [[nodiscard]] HD int ky() const { return ky_; }
    [[nodiscard]] HD int kz() const { return kz_; }
    [[nodiscard]] HD const Vec3& origin() const { return origin_; }       // permuted: x is that along kx
    [[nodiscard]] HD const Vec3& shear_factors() const { return shear_; } // S

private:
    [[nodiscard]] HD Vec3 permuted(const Vec3& v) const
    {
        const float* const axis = &v.x;
        return {axis[kx_], axis[ky_], axis[kz_]};
    }

    int kx_, ky_, kz_;
    Vec3 origin_; // permuted
    Vec3 shear_;
};

/// px qy - py qx, of which the products are exact in double and the difference rounds once: its sign is
/// that of the exact value.
HD inline double edge_in_double(const Vec3& p, const Vec3& q)
{
    return static_cast<double>(p.x) * q.y - static_cast<double>(p.y) * q.x;
}

/// The same with as much effort as its sign takes: rounding does not turn the order of two products
/// round, it can only make them equal [Woop et al. 2013, sec. 3.3].
HD inline float edge_sign(const Vec3& p, const Vec3& q)
{
    const float difference = p.x * q.y - p.y * q.x;
    return difference != 0 ? difference : static_cast<float>(edge_in_double(p, q));
}

/// If the ray meets the triangle at 0 < t < `limit`: sets `t`, `b1`, `b2`. Edges and corners belong to
/// it, and both sides count; seen exactly edge-on it is not met. Exact but for the sheared vertices, and
/// for the final rounding of the three numbers.
HD inline bool intersect_triangle(const ShearedRay& ray, const Triangle& triangle, float limit, Hit& hit)
{
    const Vec3 A = ray.shear(triangle.vertices[0]);
    const Vec3 B = ray.shear(triangle.vertices[1]);
    const Vec3 C = ray.shear(triangle.vertices[2]);
    const float u = edge_sign(C, B);
    const float v = edge_sign(A, C);
    const float w = edge_sign(B, A);
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;

    // Inside. Slivers need the weights to full precision, and not only their signs.
    const double U = edge_in_double(C, B);
    const double V = edge_in_double(A, C);
    const double W = edge_in_double(B, A);
    const double det = U + V + W; // of one sign: 0 only if all are
    if (det == 0) return false;
    const double T = U * A.z + V * B.z + W * C.z;
    if ((T < 0) != (det < 0)) return false; // behind, as is what a ray has left: no need to divide
    const auto t = static_cast<float>(T / det);
    if (!(t > 0 && t < limit)) return false;
    hit.t = t;
    hit.b1 = static_cast<float>(V / det);
    hit.b2 = static_cast<float>(W / det);
    return true;
}

} // namespace fast
