#pragma once

// The leaves of a wide tree: up to eight triangles, stored so that all of them are tested at once.

#include "cuda/parallel/lanes.h"
#include "cuda/trees/intersect.h"
#include "cuda/trees/rounding.h"
#include "cuda/trees/wide_node.h"

#include <cstdint>
#include <limits>

namespace fast {

/// Lane i holds triangle i, or NaN if there is no triangle i.
struct alignas(32) TriangleGroup {
    Lanes vertices[3][3];                    // first, second, third vertex; x, y, z
    std::uint32_t primitives[most_in_group]; // by lane; no_primitive in an empty lane

    [[nodiscard]] HD Triangle triangle(int lane) const
    {
        Triangle one{};
        for (int k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis) one.vertices[k][axis] = vertices[k][axis][lane];
        return one;
    }
};

/// The first, second or third vertices of a group, sheared as by ShearedRay::shear, but with z not
/// scaled.
struct ShearedVertices {
    Lanes x, y, z;

    HD ShearedVertices(const ShearedRay& ray, const Lanes (&vertices)[3])
        : z(vertices[ray.kz()] - all_lanes(ray.origin().z))
    {
        x = vertices[ray.kx()] - all_lanes(ray.origin().x) - all_lanes(ray.shear_factors().x) * z;
        y = vertices[ray.ky()] - all_lanes(ray.origin().y) - all_lanes(ray.shear_factors().y) * z;
    }
    /// The largest distance from the ray along x or y.
    [[nodiscard]] HD Lanes reach() const { return larger(magnitude(x), magnitude(y)); }
};

/// Edge functions in single precision, without the step in double that the sign may need
/// (intersect.h).
HD inline Lanes edges(const ShearedVertices& p, const ShearedVertices& q)
{
    return p.x * q.y - p.y * q.x;
}

/// Bit i is set if the ray may hit triangle i at a t > 0: for every triangle that it does hit, and for
/// few others. So the exact test that follows need not be fast.
///
/// Inside: an edge function that is not 0 has its true sign; one that is 0 counts as either sign.
///
/// In front: half of the triangles whose inside the ray's line crosses are behind the ray, often the
/// one that the ray has just left. Let X be the largest |x| or |y|, and Z the sum of all |z|. An edge
/// function is at most 2 X^2 and has an error of 4 u X^2. In T = U z_A + V z_B + W z_C this gives 4 u
/// X^2 Z; the products add 2 u X^2 Z, the sums 4 u X^2 Z, and the rounding of the z of
/// intersect_triangle 2 u X^2 Z: together less than 16 u X^2 Z. An underflow has an error of less than
/// the smallest normal number. An overflow counts as in front; but products of two lengths must be
/// within the range of floats.
HD inline LaneBits may_hit(const ShearedRay& ray, const TriangleGroup& group)
{
    const ShearedVertices A(ray, group.vertices[0]);
    const ShearedVertices B(ray, group.vertices[1]);
    const ShearedVertices C(ray, group.vertices[2]);
    const Lanes U = edges(C, B);
    const Lanes V = edges(A, C);
    const Lanes W = edges(B, A);
    const Lanes least = smaller(smaller(U, V), W);
    const Lanes most = larger(larger(U, V), W);

    // No return where the line passes through no triangle: that is predicted wrongly too often.
    constexpr float tiny = std::numeric_limits<float>::min();
    const Lanes X = larger(larger(A.reach(), B.reach()), C.reach());
    const Lanes Z = magnitude(A.z) + magnitude(B.z) + magnitude(C.z);
    const Lanes bound = (X + X) * (X + X) * Z; // bounds |T|: infinite if a term of T is
    const Lanes error = all_lanes(4 * unit_roundoff) * bound + all_lanes(tiny) * (Z + all_lanes(1));
    const Lanes T = (U * A.z + V * B.z + W * C.z) * all_lanes(ray.shear_factors().z < 0 ? -1.0f : 1.0f);
    // If the first argument is NaN, the second is taken.
    return non_negative(larger(smaller(error + T, least), smaller(error - T, -most)));
}

/// Calls found(hit) for every triangle of the group that the ray hits at 0 < t < `limit`. If lanes are
/// computed one after the other, the test of all lanes in advance is left out, since it would only use
/// registers. (NaN is not hit.)
template <class Found>
HD void intersect_group(const ShearedRay& ray, const TriangleGroup& group, float limit,
                        const Found& found)
{
    LaneBits candidates = lanes_at_once ? may_hit(ray, group) : (1u << most_in_group) - 1;
    while (candidates != 0) {
        const int lane = take_lane(candidates);
        Hit hit{0, group.primitives[lane], 0, 0};
        if (intersect_triangle(ray, group.triangle(lane), limit, hit)) found(hit);
    }
}

} // namespace fast
