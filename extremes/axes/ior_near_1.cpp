// Glass that is nearly air: an index of refraction of 1 + 10^-k or 1 - 10^-k.

#include "extremes/axes/axes.h"
#include "extremes/glass/glass_case.h"

#include <algorithm>
#include <cmath>

namespace extremes {

namespace {

/// A quarter of the rays are near grazing incidence, where glass like this still reflects. None is near
/// the critical angle, which has an axis of its own: there the square of cos_t is near 0, and here its
/// magnitude is at least a quarter of |1 - eta^2|.
GlassCase nearly_air(double parameter, Random& random)
{
    const Exact excess = random.sign() * Exact(parameter);
    const bool outside = random.sign() > 0;
    const bool has_critical_angle = (excess > 0) != outside;
    if (!has_critical_angle) {
        const double cos_i = random.sign() > 0
                                 ? 1.0 - random.uniform()
                                 : random.log_between(1e-3 * std::min(1.0, std::sqrt(parameter)), 1.0);
        return incident(excess, outside, cos_i, random);
    }
    const Exact eta = outside ? 1 / (1 + excess) : 1 + excess;
    const Exact difference = eta * eta - 1;
    const double quarter = 0.25 * difference.to_double();
    Exact cos2_t;
    switch (random.below(4)) {
    case 0:
        cos2_t = -difference * random.between(0.25, 1.0 - 0x1p-20);
        break;
    case 1:
        cos2_t = Exact(random.between(quarter, 1.0));
        break;
    default:
        cos2_t = Exact(random.log_between(quarter, 1.0));
    }
    return refracted(excess, outside, cos2_t, random);
}

// The derivative of the reflectance by the square of cos_t, times |n - 1|, is largest where |cos_t^2|
// is as small as is allowed, and on the side with a critical angle: 1/3 for n near 1. Where |n - 1| is
// up to 0.51, the largest value is 0.33, too (evaluated on a grid of angles). The error of cos_t itself
// is that of its square, D, over 2 cos_t, where cos_t^2 >= |1 - eta^2| / 4 >= 1.5 |n - 1| / 4, or
// cos_t^2 >= |1 - eta^2| where there is no critical angle. Terms of second order, relative to this, are
// D / (4 cos_t^2), which is less than 5% inside the limits.
double bound_nearly_air(Format format, double parameter)
{
    const double of_cos2_t = error_of_cos2_t(format, 1 / (1 - parameter));
    return 1.05 * of_cos2_t * std::max(1 / (3 * parameter), 1 / std::sqrt(1.5 * parameter)) +
           error_of_shares(format);
}

} // namespace

Axis ior_near_1_axis()
{
    Axis axis;
    axis.number = 8;
    axis.name = "ior-near-1";
    axis.title = "Glass that is nearly air";
    axis.parameter = "distance of the index of refraction from 1";
    axis.about =
        "A ray meets glass with an index of refraction of 1 plus or minus the parameter, from either "
        "side, at a random angle that is not close to the critical one; some of the rays are near "
        "grazing incidence. The error is the largest of three: the share of the light that is "
        "reflected, relative to all of it; the angle between the refracted ray and the true one; and "
        "the factor of the radiance, relative to itself. The truth is Snell's law and Fresnel's "
        "equations with sixty digits. Large errors occur near grazing incidence only, within an "
        "angle of the square root of the parameter from the surface.";
    axis.ordinary = std::pow(10.0, -0.5);
    axis.logarithmic = true;
    axis.values = powers_of_ten(-20, -0.5, 0.5);
    axis.values.back() = axis.ordinary;
    axis.methods = glass_methods(nearly_air);
    const std::string because = "cos_t^2 is the difference of numbers near 1 and has an error of 11 to "
                                "14 roundings; near grazing incidence it is as small as n - 1";
    axis.limits = {{"ref", 5e-14, [](double x) { return bound_nearly_air(Format::binary64, x); }, 3e-15,
                    Failure::inaccurate, because},
                   {"host", 2.5e-5, [](double x) { return bound_nearly_air(Format::binary32, x); }, 3e-6,
                    Failure::inaccurate, because}};
    axis.derivation =
        "let D be the error of the square of the cosine of refraction, 11 to 14 roundings of u. "
        "The derivative of the reflectance by this square is largest near grazing incidence, "
        "where it is 1/(3 x) for a distance x of the index from 1; the cosine itself has an error "
        "of D over twice itself, at most D / sqrt(1.5 x). So the error is below 1.05 D max(1/(3 "
        "x), 1/sqrt(1.5 x)), plus a few u.";
    return axis;
}

} // namespace extremes
