// A field of view that is narrow, or nearly half the world.

#include "extremes/axes/axes.h"
#include "extremes/camera/camera_case.h"

#include <cmath>
#include <numbers>

namespace extremes {

namespace {

constexpr double radians_of_half = std::numbers::pi / 360; // half of an angle in degrees

double bound_of_narrow(Format format, double degrees)
{
    return bound_of_camera(format, std::tan(degrees * radians_of_half));
}

double bound_of_wide(Format format, double degrees)
{
    return bound_of_camera(format, 1 / std::tan(degrees * radians_of_half));
}

Axis common_fov_axis()
{
    Axis axis;
    axis.number = 11;
    axis.about =
        "A camera with random axes and a picture of 64 x 64 pixels. The error is the largest of three: "
        "the distance on the film, in pixels, between a random point and the one that its ray really "
        "shows; on the way back, for a direction in or near the picture, the distance in pixels between "
        "its true point and the point or pixel that is found; and the relative error of the density per "
        "solid angle. In a picture of n pixels the errors in pixels are n/64 times as large. The truth "
        "is computed with sixty digits, with axes that are exactly at right angles.";
    axis.logarithmic = true;
    return axis;
}

} // namespace

Axis fov_narrow_axis()
{
    Axis axis = common_fov_axis();
    axis.name = "fov-narrow";
    axis.title = "Narrow field of view";
    axis.parameter = "field of view, in degrees";
    axis.ordinary = 60;
    axis.values = powers_of_ten(-25, 1.5, 0.5);
    axis.values.push_back(axis.ordinary);
    axis.methods = camera_methods(narrow_field);
    const std::string because = "directions are unit vectors, whose coordinates are rounded to 2^-24 "
                                "(2^-53 in double): that is a "
                                "fraction of a pixel which grows in proportion to 1 / field of view";
    axis.limits = {{"ref", 3e-10, [](double x) { return bound_of_narrow(Format::binary64, x); }, 3e-11,
                    Failure::inaccurate, because},
                   {"host", 0.16, [](double x) { return bound_of_narrow(Format::binary32, x); }, 0.015,
                    Failure::inaccurate, because}};
    axis.derivation =
        "let T be the tangent of half the field of view. A direction is a unit vector with an "
        "error of about 3 u per coordinate, and a pixel is T/32 wide at distance 1: the error in "
        "pixels is about 100 u / T. All roundings are counted in "
        "`extremes/camera/camera_bound.cpp`.";
    return axis;
}

Axis fov_wide_axis()
{
    Axis axis = common_fov_axis();
    axis.name = "fov-wide";
    axis.title = "Field of view of nearly 180 degrees";
    axis.parameter = "180 degrees less the field of view, in degrees";
    axis.ordinary = 120;
    axis.values = powers_of_ten(-25, 2, 0.5);
    axis.values.push_back(axis.ordinary);
    axis.methods = camera_methods(wide_field);
    const std::string because =
        "at the edge of the picture the cosine to the viewing direction is half the parameter (in "
        "radians), and it is a sum of numbers of size 1 that are rounded to 2^-24 (2^-53 in double)";
    axis.limits = {{"ref", 9e-10, [](double x) { return bound_of_wide(Format::binary64, x); }, 6e-11,
                    Failure::inaccurate, because},
                   {"host", 0.42, [](double x) { return bound_of_wide(Format::binary32, x); }, 0.03,
                    Failure::inaccurate, because}};
    axis.derivation =
        "let T be the tangent of half the field of view. At the edge of the picture the cosine to "
        "the viewing direction is 1/T, and it is a sum of numbers of size 1 with an error of "
        "about 5 u: relative to itself that is 5 u T, and three times as much for the density, "
        "which has its third power. All roundings are counted in "
        "`extremes/camera/camera_bound.cpp`.";
    return axis;
}

} // namespace extremes
