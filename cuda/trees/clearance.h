#pragma once

// How far must a point be from its surface so that rays may start and segments end there?
//
// Let u = 2^-24, and let D be the diagonal of the scene's box, so that two points of surfaces differ by
// at most D in every coordinate. A bound e_i for every coordinate bounds the distance along a normal n
// by sum |n_i| e_i. To first order in u:
//
// 1. The point as computed. A triangle's is v0 + (b1 e1 + b2 e2): whatever b1 and b2 are, it is in the
//    plane, but for one rounding of each edge, one of each product and one of the inner sum,
//    3 u (b1 |e1| + b2 |e2|), and for that of the outer sum, u |p|. A sphere's is c + r n: the length of
//    n may err by 5 u (three squares, their sum, a root, a quotient, a product), the product by u, 6 u r
//    |n_i|, and the sum by u |p|.
// 2. The origin p + s n is rounded by u |p|.
// 3. A ray against a triangle (intersect.h): with v - o rounded, which moves a vertex by u D along every
//    axis, the shear moves it by another 6 u D across the ray (2 u D for S and its product, 2 u D for
//    the difference, 2 u D as the shear follows z) and 2 u D along it: by sqrt(7^2 + 7^2 + 3^2) u D
//    < 10.4 u D in all. For these vertices the signs of U, V and W are exact, and the t is a weighted
//    mean of theirs. If they all lie below a plane parallel to the triangle that the ray stays above, no
//    mean of them is at a t > 0; if a segment has both ends above it, none at a 0 < t < t_max. The mean
//    is taken in double, which moves it by less than 2^-50 D; rounding t to a float keeps its order with
//    0 and with t_max. The rounded direction of a segment moves its far end by u D along every axis, at
//    most sqrt(3) u D along n. Together less than 12.4 u D.
// 4. A ray against a sphere (sphere.h): what is reported as a hit is within 22 u M <= 22 u D of it; with
// the
//    rounded direction less than 24 u D.
// 5. The rounding of s n itself and that of these bounds are of second order. Step 1 is given u more
//    for them, steps 3 and 4 end in 16 u D and 32 u D.
//
// What no distance can promise: to which side a direction points that is closer to the surface than n's
// own error, which for a normal computed in single precision is an angle of some 4 u times the ratio of
// the triangle's longest edge to its smallest height.

#include "cuda/parallel/vec.h"
#include "cuda/trees/rounding.h"

namespace gpu {

/// For the point `position` = v0 + (b1 e1 + b2 e2) of a triangle: along every axis, how far the plane
/// that rays meet may be from it. `diagonal`: of the box around all surfaces.
HD inline Vec3 triangle_point_error(const Vec3& position, float b1, const Vec3& e1, float b2,
                                    const Vec3& e2, float diagonal)
{
    return 4 * unit_roundoff * (b1 * glm::abs(e1) + b2 * glm::abs(e2)) +
           2 * unit_roundoff * glm::abs(position) + 16 * unit_roundoff * diagonal;
}

/// The same for the point `position` = c + radius * normal of a sphere.
HD inline Vec3 sphere_point_error(const Vec3& position, float radius, const Vec3& normal, float diagonal)
{
    return 7 * unit_roundoff * radius * glm::abs(normal) + 2 * unit_roundoff * glm::abs(position) +
           32 * unit_roundoff * diagonal;
}

/// `position` moved off its surface by just its error bound, to the side that `direction` (of any
/// length) points to: a ray from there that goes on to that side cannot meet the surface that it leaves,
/// nor one that coincides with it, and neither does a segment between two such points. `normal`: unit
/// length, to either side.
HD inline Vec3 leave_surface(const Vec3& position, const Vec3& normal, const Vec3& error,
                             const Vec3& direction)
{
    const float distance = glm::dot(glm::abs(normal), error);
    return position + (glm::dot(direction, normal) < 0 ? -distance : distance) * normal;
}

} // namespace gpu
