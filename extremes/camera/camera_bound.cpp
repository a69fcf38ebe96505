#include "extremes/camera/camera_case.h"

#include <algorithm>
#include <cmath>

namespace extremes {

// Let u be the unit roundoff, T the tangent of half the field of view, and q = T / 32 the width of a
// pixel at distance 1. A film point is at X, Y from the middle there; |X|, |Y| <= T (up to 9/8 T outside
// the picture), and L = sqrt(1 + X^2 + Y^2) is its distance from the eye. To first order in u:
//
// 1. The relative error p of the computed q. The field of view is rounded to a double, which moves the
//    tangent by u (1 + T), relative to itself: by its derivative (1 + T^2) / 2 times 2 u where the angle
//    is above 1, and by u where it is less. The tangent has an error of 2 u. In the reference p =
//    (3 + T) u. The fast path computes the same and rounds it: 1 u of single precision and a little.
// 2. The ray v = X right + Y up - backward. The axes are rounded (u), and so are X and Y (u, apart from
//    p), the products (u), the sum of two terms and the sum of three: an error of length e <=
//    3 u (|X| + |Y|) + u + u sqrt(X^2 + Y^2) + u L. The coordinates of the unit vector are rounded once
//    more, u L; its length does not matter. An error e of v moves the film point by
//    sqrt(1 + X^2) e / q at most, along each axis.
// 3. Back: w is rounded (u), the axes are, the products are, and the sums add 2 u: 5 u in each scalar
//    product of unit vectors. The cosine is 1 / L. The film point, relative to the middle, has an error
//    of 5 u L / q from the numerator; the rest is relative to at most 36 pixels: 5 u L from the cosine,
//    p, and 3 u. The sum with 32 adds u 68.
// 4. The density 1 / (A cos^3): 15 u L from the cosine, 2 p, and 7 u.
//
// In 2. the errors along both axes count: sqrt(2) times the largest. Likewise in 3.
double bound_of_camera(Format format, double tan_half)
{
    const bool is_double = format == Format::binary64;
    const double u = unit_roundoff(format);
    const double T = 1.125 * tan_half; // outside the picture, in 3 and 4; for simplicity also in 2
    const double q = tan_half / (0.5 * camera_pixels);
    const double p = is_double ? 3 + tan_half : 1.01;
    const double L = std::sqrt(1 + 2 * T * T);
    const double e = (3 * 2 + std::sqrt(2.0)) * T + 1 + 2 * L;
    const double ray = std::sqrt(1 + T * T) * e / q + 36 * p;
    const double back = 5 * L / q + 36 * (5 * L + p + 3) + 68;
    const double density = 15 * L + 2 * p + 7;
    // 1% for terms of second order.
    return 1.01 * u * std::max(std::sqrt(2.0) * std::max(ray, back), density);
}

} // namespace extremes
