#pragma once

// Bounds on the difference between a single step of a path in float and the same step in double, both
// from the same vertex. Let u = 2^-24. Counts are of first order in u, and each bound below is rounded
// up from its count by enough for the second order.
//
// 1. A frame around n [Duff et al. 2017]: sign + z is rounded once and is at least 1, and a has a
//    relative error of 2u. b = x y a, at most 1/2, has one of 4u; sign x x a has one of 4u, and its
//    sum with 1 adds u. Every axis has an error of less than 5.4u.
// 2. To world space: three products and two sums per coordinate have an error of 3u (|x| + |y| + |z|)
//    <= 5.2u, the axes of 5.4u (|x| + |y|) <= 7.7u, the normalisation of 5u: 18u in total. To the
//    frame: 3u, and 5.4u for the axes x and y: 8.4u for x and y, 3u for z, 12.3u together.
// 3. A direction sampled with a cosine: the angle, at most pi, is rounded twice, 6.3u; cosine and sine
//    are accurate to a unit in the last place; product and root add 4u: 11u. In world space 29u. On
//    the sphere, where the radius carries a root and three products, 13u.
// 4. Reflected: 12.3u + 18u. Refracted: x and y have an error of 8.4u eta each, and 2u for eta and its
//    product. The square of cos_t is 1 - eta^2 (1 - c)(1 + c), where c has an error of 3u: this gives
//    6u eta^2, and 8u of rounding; call their sum e. The root of a number with error e has an error of
//    e over the root itself, and never more than sqrt(e). Near the critical angle only the latter
//    bound is useful.
// 5. A camera ray: the film coordinate is rounded by u of the film's width, its distance from the
//    middle by half of that, pixel size and product by 2u of it: less than 2.5u of the film's extent
//    along either axis. The sum of three vectors has an error of 3u of their lengths, the
//    normalisation one of 5u.
// 6. A point of a triangle, given its weights: 3u (|e1| + |e2|) + u |p|; of a sphere, given the
//    normal: 6u r + u |p|. Both as in clearance.h. The normal of a triangle: every coordinate of e1 x
//    e2 has an error of 4u |e1| |e2|, and sqrt(3) times that is less than 7u |e1| |e2|. It is divided
//    by the length of the product; the normalisation adds 5u. The normal of a sphere is compared with
//    (p - c) / r.
// 7. The cosine of two unit vectors has an error of 3u, and 5u from their directions: 8u together.
// 8. The versine v = 1 - c from a spot's axis to a direction w (emitter.h) that is computed from two
//    points: w is rounded twice in every coordinate, an angle of less than 3u, which gives 3u s where
//    s is the sine. Its length has an error of 4u, that of the axis as a float one of u, the
//    computation of v one of 5u: 10u v. The squared difference of the lengths is of second order. The
//    reference has c = dot(axis, w), where the axis is not exactly of unit length: u. Together (10 v +
//    3 s + 1) u.
//    A direction sampled in the cone has v = u1 (1 - cos_cutoff), rounded once. The c of the reference
//    has an error from the length of the axis, which enters its frame and the product: less than 8u.
//    cos^n = exp(n log1p(-v)): with e the error of v, log(1 - v) has an error of e / c, and in float one
//    of 2u of itself. The product adds u of itself, and exp 4u: n e / c + (3 n |log c| + 4) u.
//    product adds u of itself, and exp 4u: n e / c + (3 n |log c| + 4) u.

#include "ref/transport/bsdf.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace path_judge_test {

constexpr double roundoff = 0x1p-24;

/// The error of a cosine, apart from the known errors of its directions [7].
constexpr double cosine_error = 8 * roundoff;
/// The error of 1 - v against the reference's cosine `c`, from a spot's axis to another point [8].
inline double spot_cosine_error(double c)
{
    const double sine = std::sqrt(std::max(0.0, 1 - c * c));
    return (11 * (1 - c) + 3 * sine + 2) * roundoff;
}

/// The same for a direction sampled in the cone [8].
constexpr double drawn_spot_cosine_error = 8 * roundoff;

/// The relative error of c^n, where the cosine `c` > 0 is known to within `error` < c [8].
inline double spot_falloff_error(double n, double c, double error)
{
    return n > 0 ? n * error / (c - error) + (4 * n * std::abs(std::log(c)) + 5) * roundoff : 0;
}

/// The error of a direction sampled around a normal or axis, or reflected [3, 4].
constexpr double direction_error = 36 * roundoff;

/// The error of a direction refracted from a side with cosine `cos_i` to one with cosine `cos_t` [4].
inline double refraction_error(double eta, double cos_t)
{
    const double e = (6 * eta * eta + 8) * roundoff;
    return (12 * eta + 24) * roundoff + std::min(e / std::max(cos_t, 1e-30), std::sqrt(e)) + roundoff;
}

/// The relative error of a contribution's value, without the weights of its walks and its cosines:
/// squared distance, densities, colours and their products.
constexpr double in_product = 16 * roundoff;

/// The error of a camera ray's direction; `extent`: width plus height of the film at distance 1 [5].
inline double camera_direction_error(double extent)
{
    return (4 * extent + 10) * roundoff;
}

/// The error of a point of a triangle, for any weights [6].
inline double triangle_point_error(const std::array<ref::Vec3, 3>& v, const ref::Vec3& p)
{
    return roundoff * (4 * (glm::length(v[1] - v[0]) + glm::length(v[2] - v[0])) + 2 * glm::length(p));
}

/// A bound on the distance by which a point of a triangle may be moved off the edges
/// (cuda/trees/clearance.h, step 8); 0 except in a strip along the edges. `p`: the point before or
/// after the move.
inline double moved_off_edges(const std::array<ref::Vec3, 3>& v, const ref::Vec3& p)
{
    const ref::Vec3 e1 = v[1] - v[0];
    const ref::Vec3 e2 = v[2] - v[0];
    const double longest = std::max({glm::length(e1), glm::length(e2), glm::length(e2 - e1)});
    const double farthest = std::max({glm::length(v[0]), glm::length(v[1]), glm::length(v[2])});
    const double margin = std::min(0.125, roundoff * (64 + 8 * farthest / longest));
    const ref::Vec3 normal = glm::cross(e1, e2);
    const double b1 = glm::dot(glm::cross(p - v[0], e2), normal) / glm::dot(normal, normal);
    const double b2 = glm::dot(glm::cross(e1, p - v[0]), normal) / glm::dot(normal, normal);
    // The weights have an error of the point's own error over the least height.
    const double error = triangle_point_error(v, p) * longest / glm::length(normal);
    if (std::min({1 - b1 - b2, b1, b2}) > 1.01 * margin + error) return 0;
    return 2.02 * margin * longest;
}

/// The error of a point of a sphere, as a distance from the sphere [6].
inline double sphere_point_error(double radius, const ref::Vec3& p)
{
    return roundoff * (8 * radius + 2 * glm::length(p));
}

/// The error of a triangle's normal [6].
inline double triangle_normal_error(const std::array<ref::Vec3, 3>& v)
{
    const ref::Vec3 e1 = v[1] - v[0];
    const ref::Vec3 e2 = v[2] - v[0];
    const double sine = glm::length(glm::cross(e1, e2)) / (glm::length(e1) * glm::length(e2));
    return (8 / sine + 6) * roundoff;
}

/// The error of the reflectance of glass for the cosine `cos_i`, which has an error of at most
/// `error`: its variation over that range, and 16 roundings of its own, all of numbers up to 1.
inline double fresnel_error(double cos_i, double error, double eta_i, double eta_t)
{
    double cos_t = 0;
    const double middle = ref::fresnel(cos_i, eta_i, eta_t, cos_t);
    const double below = ref::fresnel(std::max(0.0, cos_i - error), eta_i, eta_t, cos_t);
    const double above = ref::fresnel(std::min(1.0, cos_i + error), eta_i, eta_t, cos_t);
    return std::max(std::abs(below - middle), std::abs(above - middle)) + 16 * roundoff;
}

} // namespace path_judge_test
