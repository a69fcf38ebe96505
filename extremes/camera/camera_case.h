#pragma once

// Random cases of a pinhole camera, with the exact answer, for several axes.

#include "extremes/axis.h"
#include "extremes/exact.h"

namespace extremes {

/// Width and height of the picture in pixels.
constexpr int camera_pixels = 64;

/// Half the field of view, in radians, at a value of the parameter: exact, and as the double that a
/// scene holds.
struct FieldOfView {
    Exact tan_half;
    double fov; // the whole of it
};

/// From an angle in degrees: the field of view, or what is missing to 180 degrees.
FieldOfView narrow_field(double degrees);
FieldOfView wide_field(double less_than_180_degrees);

/// Our wings, and a usual trick: the field of view as a float.
///
/// A case is a camera with random axes and two random film points. The error is the largest of three:
/// 1. The distance on the film, in pixels, between the first point and that which the direction of its
///    ray belongs to.
/// 2. For the unit vector in the direction of the second point, which may lie outside the picture: the
///    distance in pixels between the second point and the film point that is found, or the pixel, where
///    only that is found; if none is found, between the second point and the outside.
/// 3. Of the density per solid angle in that direction, relative to itself.
std::vector<Method> camera_methods(FieldOfView (*field)(double));

/// The bound on these errors, for the tangent of half the field of view.
double bound_of_camera(Format format, double tan_half);

} // namespace extremes
