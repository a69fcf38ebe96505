#pragma once

// A closed room of four triangles: the ordinary case of leaving a surface.

#include "extremes/leave/leave_case.h"
#include "extremes/leave/shapes.h"

#include <functional>

namespace extremes {

/// A regular tetrahedron in the unit sphere, turned at random, its corners moved by up to 0.15 along
/// each axis; then every corner is replaced by place(corner). Rays from inside meet a face, and the
/// light goes on to another face. `size`: of the error. All rays keep a weight of 0.1 off the edges, and
/// cosines of at least least_cosine to the normals of both faces, unless place() rounds the corners
/// away.
LeaveCase tetrahedron_case(Random& random, int rays, double size,
                           const std::function<scenes::Vec3(const scenes::Vec3&)>& place);

constexpr double least_cosine = 0.3;
constexpr double tetrahedron_extent = 2.3;  // largest extent along an axis: 2 + 2 * 0.15
constexpr double tetrahedron_radius = 1.15; // largest coordinate

/// The bound on the error of "ref" or "host" in a tetrahedron. `farthest`: the largest coordinate, in
/// multiples of the tetrahedron's radius, at which the implementation has placed it.
///
/// Let u be the unit roundoff, a the extent, M the largest coordinate, c the least cosine. Lengths of
/// vectors are at most sqrt(3) times their largest coordinate. To first order in u:
/// 1. The first ray. A vertex is perturbed by less than 7 u a per axis (ref/trees/geometry.cpp, step 3),
///    so the meeting point moves by 7 sqrt(3) u a / c within the face.
/// 2. The position. Computed from its weights: 7 u a + u M per axis (step 1 there).
/// 3. The offset along the normal: at most sqrt(3) (7 + 8) u a + 2 sqrt(3) u M; its rounding: u M per
///    axis.
/// 4. The second ray. A displacement s of its origin changes the distance to a plane by at most s / c;
///    its own perturbation of vertices counts like a displacement of 7 sqrt(3) u a; and the quotient t
///    carries 4 u a.
/// Sum: u (sqrt(3) (7 / c + 22 + 7) a + 4 sqrt(3) M) / c + 4 u a.
///
/// The fast path has smaller constants in steps 1 to 4, but rounds its input:
/// 5. Corners and origins are rounded by u M per axis, directions by u. This moves the meeting point by
///    sqrt(3) (2 u M + u a) / c, the target by sqrt(3) u M, and the second ray, at distance a, by
///    sqrt(3) u a, each divided by c.
double bound_in_tetrahedron(Format format, double farthest);

} // namespace extremes
