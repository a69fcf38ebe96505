// Any index of refraction, from far below 1 to far above.

#include "extremes/axes/axes.h"
#include "extremes/glass/glass_case.h"

#include <algorithm>
#include <cmath>

namespace extremes {

namespace {

/// The smallest |cos_t^2| of a ray from the side with a critical angle, which has an axis of its own.
double least_cos2_t(double eta)
{
    return 0.25 * std::min(1.0, eta * eta - 1);
}

GlassCase any_glass(double parameter, Random& random)
{
    const Exact excess = Exact(parameter) - 1;
    const bool outside = random.sign() > 0;
    const double eta = outside ? 1 / parameter : parameter;
    if (eta <= 1) return incident(excess, outside, 1.0 - random.uniform(), random);
    const double least = least_cos2_t(eta);
    if (random.below(4) == 0) {
        // Total reflection: in half of the cases just beyond the critical angle.
        const double most = 0.999 * (eta * eta - 1);
        const double cos2_t =
            random.sign() > 0 ? random.between(least, most) : random.log_between(least, most);
        return refracted(excess, outside, Exact(-cos2_t), random);
    }
    return refracted(excess, outside, Exact(random.between(least, 1.0)), random);
}

// Let D be the error of cos_t^2. On the side with a critical angle, cos_t has an error of D / (2 cos_t),
// where cos_t^2 >= 1/4 for eta >= sqrt(2): less than D. The derivative of the reflectance by cos_t^2 is
// less than 1/2 (evaluated on grids of angles, for n and 1/n from 1.4 to 10^4; it falls from there on).
// Nearer to 1 the bound is that of the axis ior-near-1. 3% is for terms of second order.
double bound_any_glass(Format format, double parameter)
{
    const double eta = std::max(parameter, 1 / parameter);
    const double near_1 = 1 / (3 * std::abs(parameter - 1));
    const double of_cos_t = 0.5 / std::sqrt(least_cos2_t(eta));
    return 1.03 * error_of_cos2_t(format, eta) * std::max({0.5, near_1, of_cos_t}) +
           error_of_shares(format);
}

} // namespace

Axis ior_axis()
{
    Axis axis;
    axis.number = 8;
    axis.name = "ior";
    axis.title = "Index of refraction";
    axis.parameter = "index of refraction";
    axis.about =
        "A ray meets glass from either side, at a random angle; on the denser side, three of four rays "
        "are within the critical angle, and none is close to it. The error is the largest of three: the "
        "share of the light that is reflected, relative to all of it; the angle between the refracted "
        "ray and the true one; and the factor of the radiance, relative to itself. The truth is Snell's "
        "law and Fresnel's equations with sixty digits.";
    axis.ordinary = 1.5;
    axis.logarithmic = true;
    for (const double power : powers_of_ten(-20, 20, 0.5)) axis.values.push_back(1.5 * power);
    axis.methods = glass_methods(any_glass);
    const auto bound_of = [](Format format) {
        return [format](double x) { return bound_any_glass(format, x); };
    };
    const std::string because =
        "the refracted rays come from a cone around the normal of radius 1/n, and the cosine there "
        "differs from 1 by less than 1/n^2: its rounding is multiplied by n^2";
    axis.limits = {
        {"ref", 5e6, bound_of(Format::binary64), 1.2e7, Failure::inaccurate, because},
        {"ref", 1 / 5e6, bound_of(Format::binary64), 1 / 1.2e7, Failure::inaccurate, because},
        {"host", 250, bound_of(Format::binary32), 500, Failure::inaccurate, because},
        {"host", 1 / 250.0, bound_of(Format::binary32), 1 / 500.0, Failure::inaccurate, because}};
    axis.derivation =
        "let n be the larger of the index and its reciprocal, and D the error of the square of "
        "the cosine of refraction: on the denser side it is a rounding of 1 - cos^2 multiplied by "
        "n^2, so about 3 u n^2 (2 u n^2 in single precision). The derivative of the reflectance "
        "by this square is below 1/2 from n = 1.4 on, and that of the cosine is below 1: the "
        "error is below 1.03 D, plus a few u.";
    return axis;
}

} // namespace extremes
