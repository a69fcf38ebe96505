#pragma once

// The leaves of a wide tree: up to four triangles, stored so that the processor tests all of them at
// once.

#include "cuda/parallel/lanes.h"
#include "cuda/trees/intersect.h"
#include "cuda/trees/rounding.h"

#include <cstdint>
#include <limits>

namespace fast {

/// Lane i holds triangle i, or NaN where there is none.
struct alignas(32) TriangleGroup {
    Lanes vertices[3][3];        // first, second, third vertex; x, y, z
    std::uint32_t primitives[4]; // by lane; no_primitive where there is none

    [[nodiscard]] HD Triangle triangle(int lane) const
    {
        Triangle one{};
        for (int k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis) one.vertices[k][axis] = vertices[k][axis][lane];
        return one;
    }
};

/// The first, second or third vertices of a group as ShearedRay::shear sees them; but z is not scaled.
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

/// Edge functions without the second look that their sign may need (intersect.h).
HD inline Lanes edges(const ShearedVertices& p, const ShearedVertices& q)
{
    return p.x * q.y - p.y * q.x;
}

/// Bit i is set if the ray may hit triangle i at a t > 0: for every one that it does hit, and for few
/// others. So what comes after need not be fast.
///
/// Inside: an edge function that is not 0 has its true sign; one that is 0 counts for either.
///
/// In front: of what rays pass inside, half is behind them, most of all what they have just left. Let X
/// be the largest |x| or |y|, Z the sum of all |z|. An edge function is 2 X^2 at most and errs by 4 u
/// X^2. In T = U z_A + V z_B + W z_C that makes 4 u X^2 Z, the products another 2 and the sums 4, and
/// the z of intersect_triangle are rounded once more, which is 2: together less than 16 u X^2 Z. What
/// underflows errs by less than the smallest normal number. What overflows counts as in front; but
/// products of two lengths must be within the range of floats.
HD inline std::uint32_t may_hit(const ShearedRay& ray, const TriangleGroup& group)
{
    const ShearedVertices A(ray, group.vertices[0]);
    const ShearedVertices B(ray, group.vertices[1]);
    const ShearedVertices C(ray, group.vertices[2]);
    const Lanes U = edges(C, B);
    const Lanes V = edges(A, C);
    const Lanes W = edges(B, A);
    const Lanes least = smaller(smaller(U, V), W);
    const Lanes most = larger(larger(U, V), W);
    if (non_negative_mask(larger(least, -most)) == 0) return 0;

    constexpr float tiny = std::numeric_limits<float>::min();
    const Lanes X = larger(larger(A.reach(), B.reach()), C.reach());
    const Lanes Z = magnitude(A.z) + magnitude(B.z) + magnitude(C.z);
    const Lanes bound = (X + X) * (X + X) * Z; // of |T|: infinite if anything in T is
    const Lanes error = all_lanes(4 * unit_roundoff) * bound + all_lanes(tiny) * Z + all_lanes(tiny);
    const Lanes T = (U * A.z + V * B.z + W * C.z) * all_lanes(ray.shear_factors().z < 0 ? -1.0f : 1.0f);
    // Where the first argument is NaN the second counts.
    return non_negative_mask(larger(smaller(error + T, least), smaller(error - T, -most)));
}

/// Calls found(hit) for every triangle of the group that the ray hits at 0 < t < `limit`. Where lanes
/// take turns, a first look at all of them would only keep registers from other threads. (NaN is not
/// hit.)
template <class Found>
HD void intersect_group(const ShearedRay& ray, const TriangleGroup& group, float limit,
                        const Found& found)
{
    const std::uint32_t candidates = lanes_at_once ? may_hit(ray, group) : 0xfu;
    for (int lane = 0; candidates >> lane != 0; ++lane) {
        Hit hit{0, group.primitives[lane], 0, 0};
        if ((candidates >> lane & 1) != 0 && intersect_triangle(ray, group.triangle(lane), limit, hit))
            found(hit);
    }
}

} // namespace fast
