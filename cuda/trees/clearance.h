#pragma once

// How far must a point be from its surface so that rays may start and segments end there?
//
// Let u = 2^-24. A bound e_i for every coordinate bounds the distance along a normal n by sum |n_i| e_i.
// Of a triangle let a_i be the extent of its box along axis i, and a the largest of them. The size of
// the scene does not count: rounding acts on what lies between a ray's origin and the surface that it
// has left, or comes to. To first order in u:
//
// 1. The point as computed. A triangle's is v0 + (b1 e1 + b2 e2): whatever b1 and b2 are, it is in the
//    plane, but for one rounding of each edge, one of each product and one of the inner sum,
//    3 u (b1 |e1| + b2 |e2|), and for that of the outer sum, u |p|. A sphere's is c + r n: the length of
//    n may err by 5 u (three squares, their sum, a root, a quotient, a product), the product by u, 6 u
//    r, and the sum by u |p|.
// 2. The origin p + s n is rounded by u |p|.
// 3. A ray that leaves a triangle, against that triangle (intersect.h). A vertex at m = v - o from the
//    origin has |m_i| <= a_i, and is moved along an axis across the ray by u |m_i| (the difference),
//    3 u |m| (S, its product, and of the last difference the part of m_z) and u |m_i| (the other part);
//    and by the 2 roundings of its t along the ray, 2 u |m| on every axis, where |m| is the largest
//    component: 2 u a_i + 5 u a. For the vertices so moved the signs of U, V and W are exact, and the t
//    is a weighted mean of theirs, in double. If they all lie below a plane parallel to the triangle
//    that the ray stays above, no mean of them is at a t > 0. Rounding t to a float keeps its order with
//    0 and with t_max.
// 4. A segment d that ends on a triangle: |m_i| <= |d_i| + a_i, and the rounded direction moves its
//    end by u |d_i|. Beyond step 3 that is 3 u |d_i| + 5 u |d|, along n less than 11.7 u times its
//    length.
// 5. A sphere (sphere.h): what is reported as a hit is within 22 u M of it, M the larger of 2 r and the
//    distance of the origin from the centre. Where a ray leaves it, M = 2 r: 44 u r. Where a segment
//    ends, M <= 2 r + |d|; with its rounded direction less than 24 u |d| more.
// 6. The rounding of s n itself and that of these bounds are of second order: u more in step 1, u a
//    more in step 3 and 5 u r more in step 5 are room for it.
// 7. Surfaces that coincide with a triangle may be larger than it is: then a is the largest of theirs.
//    A neighbour in the same plane needs no more than the triangle itself where they share an edge: near
//    that edge the place of the neighbour's third vertex has no weight.
//
// 8. Two triangles that meet at an edge. A point in that edge may be rounded to the far side of the
//    second one, and a step along the normal of the first does not bring it back. So a point is kept off
//    the edges of its triangle: no vertex has a weight less than m, and the point is m h from an edge
//    over which the triangle has the height h. The second triangle needs its own clearance of that, at
//    most 21 u a + 3.5 u |p| by steps 1 and 3. Let L be the longest edge, and h >= L / 2, as of half a
//    rectangle that is not long. Then m = u (64 + 8 |p| / L) is enough for a second triangle that is not
//    larger than the first, and leaves 11 u L for angles of less than 90 degrees.
//    It moves a point by at most 2 m L, and only in a strip of this width. Where L is so small that
//    floats hardly place the vertices, m is kept to 1/8.
//
// What no distance can promise: to which side a direction points that is closer to the surface than n's
// own error, which for a normal computed in single precision is an angle of some 4 u times the ratio of
// the triangle's longest edge to its smallest height.

#include "cuda/parallel/vec.h"
#include "cuda/trees/rounding.h"

namespace fast {

/// Of a triangle with these edges from its first vertex: the extent of its box along every axis.
HD inline Vec3 triangle_extent(const Vec3& e1, const Vec3& e2)
{
    return glm::max(glm::max(e1, e2), Vec3(0.0f)) - glm::min(glm::min(e1, e2), Vec3(0.0f));
}

/// What a point of a triangle with these edges and this normal (unit length) must be away from its plane
/// wherever it lies: steps 1 and 3 with the largest weights, but for what grows with the position.
/// `extent`: of the triangle, or of what coincides with it.
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

/// The least weight of a vertex in a point of the triangle from v0 with these edges: step 8.
inline float edge_margin(const Vec3& v0, const Vec3& e1, const Vec3& e2)
{
    const float longest = glm::max(glm::max(glm::length(e1), glm::length(e2)), glm::length(e2 - e1));
    const float farthest =
        glm::max(glm::length(v0), glm::max(glm::length(v0 + e1), glm::length(v0 + e2)));
    const float margin = unit_roundoff * (64.0f + 8.0f * farthest / longest);
    return margin < 0.125f ? margin : 0.125f; // also where all edges are 0
}

/// Moves the point with weights b1 and b2 of the second and third vertex off the edges: no weight is
/// less than `margin`, but for the factor by which their sum becomes 1 again.
HD inline void move_off_edges(float margin, float& b1, float& b2)
{
    float b0 = 1.0f - b1 - b2;
    if (glm::min(b0, glm::min(b1, b2)) >= margin) return;
    b0 = glm::max(b0, margin);
    b1 = glm::max(b1, margin);
    b2 = glm::max(b2, margin);
    const float to_unit = 1.0f / (b0 + b1 + b2);
    b1 *= to_unit;
    b2 *= to_unit;
}

/// How far from its surface, along the normal, rays must begin at `position`. `own`: the clearance of
/// the triangle or sphere wherever it is.
HD inline float clearance_at(const Vec3& position, const Vec3& normal, float own)
{
    return own + 2 * unit_roundoff * glm::dot(glm::abs(normal), glm::abs(position));
}

/// How much further from a surface, per unit of its length, a segment that comes to it must end.
constexpr float clearance_per_length = 24 * unit_roundoff;

/// `position` moved off its surface by `clearance`, to the side that `direction` (of any length) points
/// to. `normal`: unit length, to either side. A ray from there that goes on to that side cannot meet the
/// surface that it leaves, nor one that coincides with it; nor does a segment that ends there, moved off
/// by clearance_per_length times its length more.
HD inline Vec3 leave_surface(const Vec3& position, const Vec3& normal, float clearance,
                             const Vec3& direction)
{
    return position + (glm::dot(direction, normal) < 0 ? -clearance : clearance) * normal;
}

} // namespace fast
