// Rays near the critical angle of total reflection.

#include "extremes/axes/axes.h"
#include "extremes/glass/glass_case.h"

#include <algorithm>
#include <cmath>

namespace extremes {

namespace {

constexpr double least_ior = 1.2;
constexpr double largest_ior = 2.5;

/// From inside; the angle of incidence is `parameter` away from the critical one, on either side.
GlassCase near_critical_angle(double parameter, Random& random)
{
    const Exact ior = random.between(least_ior, largest_ior);
    // The critical angle a has the sine 1/n, and n sin(a + d) = cos d + sqrt(n^2 - 1) sin d. `parameter`
    // is taken as 2 tan(d / 2), of which sin d and cos d are rational functions; d is smaller by d^3
    // / 12.
    const Exact half = random.sign() * Exact(parameter / 2);
    const Exact square = half * half;
    const Exact sine = (1 - square + 2 * half * sqrt(ior * ior - 1)) / (1 + square);
    return refracted(ior - 1, false, 1 - sine * sine, random);
}

/// An upper bound on D / cos_t^2, where D is the error of the square of cos_t, for cases with
/// total reflection or without it.
///
/// With g = sqrt(n^2 - 1), cos_t^2 = 1 - (cos d - g sin d)^2 >= 2 g d (1 - g d / 2). D / (2 g) is
/// largest for the smallest n (12.1 u / 1.32 in single precision, 11.4 u / 1.32 in double).
double error_near_critical_angle(Format format, double parameter)
{
    double largest = 0;
    for (const double ior : {least_ior, largest_ior}) {
        const double g = std::sqrt(ior * ior - 1);
        const double cos2_t = 2 * g * parameter * (1 - g * parameter / 2);
        largest = std::max(largest, error_of_cos2_t(format, ior) / cos2_t);
    }
    return largest;
}

// The error of cos_t is D / cos_t, but never more than sqrt(D), since the roots of two numbers differ by
// no more than the root of their difference. The derivative of the reflectance by cos_t at 0 is
// 2 (1 + n^2) / g, and less elsewhere. Together that is at most 28 sqrt(u) for these n in single
// precision, and 32.2 sqrt(u) in double: no failure, at any angle.

/// Of the transmitted share T, relative to itself. For each polarisation T is 4 a b / (a + b)^2, where
/// one of a and b has the factor cos_t, so T changes relatively by no more than cos_t does: half as much
/// as its square, and 10% more for terms of second order. The share is 1 less the reflected one, which
/// has an error of its own; T is at least 4 cos_t / (1 + cos_t)^2 / n > 0.8 cos_t.
double bound_of_transmission(Format format, double parameter)
{
    const double cos_t = std::sqrt(1.2 * parameter);
    return 0.55 * error_near_critical_angle(format, parameter) + error_of_shares(format) / (0.8 * cos_t);
}

} // namespace

Axis critical_angle_axis()
{
    Axis axis;
    axis.number = 8;
    axis.name = "critical-angle";
    axis.title = "Near the critical angle";
    axis.parameter = "distance from the critical angle, in radians";
    axis.about =
        "Inside glass with a random index of refraction from 1.2 to 2.5, a ray meets the surface at the "
        "critical angle plus or minus the parameter. The error is the larger of the error of the "
        "reflected share, relative to all light, and the angle between the refracted ray and the true "
        "one. It is never more than 33 times the square root of the unit roundoff: 0.8% in single "
        "precision. "
        "The methods with the word \"transmitted\" have the error of the transmitted share relative to "
        "itself; light that passes where there is total reflection is a leak. The truth is Snell's law "
        "and Fresnel's equations with sixty digits.";
    axis.ordinary = 0.1;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-18, -1, 0.5);
    axis.values.back() = axis.ordinary;
    axis.methods = glass_methods(near_critical_angle);
    std::vector<Method> transmitted;
    for (const Wing wing : wings())
        transmitted.push_back(transmission_method(
            name_of(wing) + " transmitted", format_of(wing),
            [wing](const GlassInput& input) { return glass_by(wing, input); }, near_critical_angle));
    // Behind the wings, and before the tricks.
    axis.methods.insert(axis.methods.begin() + static_cast<std::ptrdiff_t>(transmitted.size()),
                        transmitted.begin(), transmitted.end());
    const std::string because = "the square of cos_t is 2 sqrt(n^2 - 1) times the parameter, and the "
                                "difference of numbers near 1 with an error of 12 to 29 roundings";
    axis.limits = {
        {"ref transmitted", 8e-14, [](double x) { return bound_of_transmission(Format::binary64, x); },
         1e-15, Failure::inaccurate, because},
        {"host transmitted", 4e-5, [](double x) { return bound_of_transmission(Format::binary32, x); },
         1e-6, Failure::inaccurate, because}};
    axis.derivation =
        "at a distance d from the critical angle the square of the cosine of refraction is 2 "
        "sqrt(n^2 - 1) d to first order, with an error D of 12 to 29 u. The transmitted share has "
        "the cosine as a factor, so its relative error is half of D over the square, plus 10% for "
        "terms of second order. The reflected share never errs by more than 33 sqrt(u): the roots "
        "of two numbers differ by no more than the root of their difference.";
    return axis;
}

} // namespace extremes
