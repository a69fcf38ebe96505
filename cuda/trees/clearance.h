#pragma once

// How far must a point be from its surface so that rays can start and segments can end there?
//
// Let u = 2^-24. If every coordinate has an error bound e_i, the distance along a normal n has the
// error bound sum |n_i| e_i. For a triangle, a_i is the extent of its box along axis i, and a is the
// largest a_i. The size of the scene does not matter, because rounding acts on the vector between a
// ray's origin and the surface that it has left or reaches. To first order in u:
//
// 1. The computed point.
//    For a triangle it is v0 + (b1 e1 + b2 e2). For any b1 and b2 it is in the plane, up to one rounding
//    of each edge, one of each product and one of the inner sum, 3 u (b1 |e1| + b2 |e2|), and up to the
//    rounding of the outer sum, u |p|. For a sphere it is c + r n: the length of n may have an error of
//    5 u (three squares, their sum, a root, a quotient, a product), and the product one of u, together
//    6 u r; the sum has one of u |p|.
// 2. The origin p + s n is rounded by u |p|.
// 3. A ray that leaves a triangle, tested against that triangle (intersect.h).
//    A vertex at m = v - o from the origin o has |m_i| <= a_i. Let |m| be the largest component of m.
//    The vertex is moved, along an axis i across the ray,
//      by u |m_i| in the difference v - o,
//      by 3 u |m| in S, in its product, and in the m_z part of the last difference,
//      by u |m_i| in the other part of the last difference,
//    and, along the ray, by the 2 roundings of its t: 2 u |m| on every axis. The sum is
//    2 u a_i + 5 u a. For the vertices moved in this way the signs of U, V and W are exact, and the t of
//    the hit is a weighted mean of the t of the vertices, in double. If all vertices lie below a plane
//    parallel to the triangle, and the ray stays above it, no mean of them is at a t > 0. Rounding t to
//    a float keeps its order with 0 and with t_max.
// 4. A segment d that ends on a triangle.
//    Here |m_i| <= |d_i| + a_i, and the rounded direction moves the end by u |d_i|. Compared with step 3
//    this adds 3 u |d_i| + 5 u |d|, which along n is less than 11.7 u times the length of d.
// 5. A sphere (sphere.h).
//    A reported hit is within 22 u M of the sphere, where M is the larger of 2 r and the distance of the
//    origin from the centre. Where a ray leaves the sphere, M = 2 r: 44 u r. Where a segment ends,
//    M <= 2 r + |d|; together with the rounded direction this adds less than 24 u |d|.
// 6. The rounding of s n itself and that of these bounds are of second order. They are covered by
//    adding u in step 1, u a in step 3 and 5 u r in step 5.
// 7. Surfaces that coincide with a triangle may be larger than it. Then a is the largest of their
//    extents. A neighbour in the same plane needs no more than the triangle itself where they share an
//    edge: near that edge the third vertex of the neighbour has no weight.
//
// 8. Two triangles that meet at an edge.
//    A point in that edge may be rounded to the far side of the second triangle, and a step along the
//    normal of the first does not bring it back. So a point is kept off the edges of its triangle: no
//    vertex has a weight less than m. The point is then m h from an edge over which the triangle has the
//    height h. The point must have the clearance of the second triangle from it, at most
//    21 u a + 3.5 u |p| by steps 1 and 3. Let L be the longest edge, and let h >= L / 2, as in half of a
//    rectangle that is not long. Then m = u (64 + 8 |p| / L) is enough for a second triangle that is not
//    larger than the first, with 11 u L to spare for angles of less than 90 degrees.
//    This moves a point by at most 2 m L, and only in a strip of this width. Where L is so small that
//    floats hardly resolve the vertices, m is limited to 1/8.
//
// The limit of every clearance: n has an error of its own. For a normal computed in single precision
// it is an angle of about 4 u times the ratio of the triangle's longest edge to its smallest height.
// For a direction closer to the surface than that angle, the side to which it points is unknown.

#include "cuda/parallel/number.h"
#include "cuda/trees/rounding.h"

namespace fast {

/// The extent, along every axis, of the box of a triangle with these edges from its first vertex.
HD inline Vec3 triangle_extent(const Vec3& e1, const Vec3& e2)
{
    return glm::max(glm::max(e1, e2), Vec3(0.0f)) - glm::min(glm::min(e1, e2), Vec3(0.0f));
}

/// The clearance that a point anywhere in a triangle with these edges and this normal (unit length)
/// needs from its plane: steps 1 and 3 with the largest weights, without the terms that grow with the
/// position (clearance_at adds them). `extent`: of the triangle, or of the surfaces that coincide with
/// it.
HD inline float triangle_clearance(const Vec3& normal, const Vec3& e1, const Vec3& e2,
                                   const Vec3& extent)
{
    const Vec3 error =
        4.0f * glm::max(glm::abs(e1), glm::abs(e2)) + 2.0f * extent + 6.0f * max_component(extent);
    return unit_roundoff * glm::dot(glm::abs(normal), error);
}

/// The same for a sphere.
HD inline float sphere_clearance(float radius)
{
    return 56 * unit_roundoff * radius;
}

/// The smallest weight that a vertex may have in a point of the triangle from v0 with these edges:
/// step 8.
inline float edge_margin(const Vec3& v0, const Vec3& e1, const Vec3& e2)
{
    const float longest = glm::max(glm::max(glm::length(e1), glm::length(e2)), glm::length(e2 - e1));
    const float farthest =
        glm::max(glm::length(v0), glm::max(glm::length(v0 + e1), glm::length(v0 + e2)));
    const float margin = unit_roundoff * (64.0f + 8.0f * farthest / longest);
    return margin < 0.125f ? margin : 0.125f; // also where all edges are 0
}

/// Moves the point with weights b1 and b2 of the second and third vertex off the edges. Afterwards no
/// weight is less than `margin` times the factor that makes the sum of the weights 1 again.
template <class F>
HD void move_off_edges(const F& margin, F& b1, F& b2)
{
    const F b0 = 1.0f - b1 - b2;
    const MaskOf<F> near = !(lesser(b0, lesser(b1, b2)) >= margin);
    if (none(near)) return;
    const F moved1 = greater(b1, margin);
    const F moved2 = greater(b2, margin);
    const F to_unit = 1.0f / (greater(b0, margin) + moved1 + moved2);
    b1 = select(near, moved1 * to_unit, b1);
    b2 = select(near, moved2 * to_unit, b2);
}

/// The distance from the surface, along the normal, at which rays must start that leave `position`.
/// `own`: triangle_clearance or sphere_clearance of the surface.
template <class F>
HD F clearance_at(const Vec3Of<F>& position, const Vec3Of<F>& normal, const F& own)
{
    return own + 2 * unit_roundoff * glm::dot(magnitude_of(normal), magnitude_of(position));
}

/// The additional distance from the surface for the end of a segment, per unit of the segment's
/// length.
constexpr float clearance_per_length = 24 * unit_roundoff;

/// `position` moved off its surface by `clearance`, to the side that `direction` (of any length)
/// points to. `normal`: unit length, to either side. A ray that starts there and goes to that side
/// cannot meet the surface that it leaves, nor one that coincides with it. The same holds for a
/// segment that ends there, if the clearance is larger by clearance_per_length times its length.
template <class F>
HD Vec3Of<F> leave_surface(const Vec3Of<F>& position, const Vec3Of<F>& normal, const F& clearance,
                           const Vec3Of<F>& direction)
{
    return position + select(glm::dot(direction, normal) < 0.0f, -clearance, clearance) * normal;
}

} // namespace fast
