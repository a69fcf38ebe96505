#pragma once

#include "extremes/axis.h"

namespace extremes {

/// The bound on the error of "ref" or "host" in the distance that light goes from a triangle to another
/// one, in the unit of the arguments. `extent`: a, the largest difference of two coordinates in the
/// scene, the origins of rays included. `farthest`: M, the largest coordinate at which the
/// implementation has placed the scene. `cosine`: c, the least |cosine| between the second direction and
/// the normal of the second triangle. `first_cosine`: d, that of the first direction and the first
/// triangle. Directions have unit length.
///
/// Let u be the unit roundoff. The length of a vector is at most sqrt(3) times its largest coordinate.
/// To first order in u:
/// 1. The first ray. A vertex is perturbed by less than 7 u a per axis (ref/trees/geometry.cpp, step 3),
///    so the meeting point moves by 7 sqrt(3) u a / d within the triangle.
/// 2. The position. Computed from its weights: 7 u a + u M per axis (step 1 there).
/// 3. The offset along the normal: at most sqrt(3) (7 + 8) u a + 2 sqrt(3) u M; its rounding: u M per
///    axis.
/// 4. The second ray. A displacement s of its origin changes the distance to a plane by at most s / c;
///    its own perturbation of vertices counts like a displacement of 7 sqrt(3) u a; and the quotient t
///    carries 4 u sqrt(3) a.
/// Sum: u (sqrt(3) (7 / d + 22 + 7) a + 4 sqrt(3) M) / c + 4 sqrt(3) u a.
///
/// The fast path has smaller constants in steps 1 to 4, but rounds its input:
/// 5. Corners and origins are rounded by u M per axis, directions by u. This moves the meeting point by
///    sqrt(3) (2 u M + u sqrt(3) a) / d, the target by sqrt(3) u M, and the second ray, at a distance of
///    at most sqrt(3) a, by 3 u a; all this divided by c.
double bound_of_leaving(Format format, double extent, double farthest, double cosine,
                        double first_cosine);

} // namespace extremes
