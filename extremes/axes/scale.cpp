// The same scene in another unit of length.

#include "extremes/axes/axes.h"
#include "extremes/leave/tetrahedron.h"

#include <algorithm>

namespace extremes {

namespace {

LeaveCase scaled(double parameter, Random& random, int rays)
{
    return tetrahedron_case(random, rays, parameter,
                            [&](const scenes::Vec3& v) { return parameter * v; });
}

} // namespace

Axis scale_axis()
{
    Axis axis;
    axis.number = 1;
    axis.name = "scale";
    axis.title = "Scale of the scene";
    axis.parameter = "radius of the scene, in units of the file";
    axis.about =
        "A closed room of four triangles, in another unit of length. A ray from inside meets a wall, "
        "and "
        "the light goes on to another wall. The error is that of the distance between the two points, "
        "relative to the room's radius. The truth follows exactly from the coordinates of the file, "
        "which "
        "are doubles: below 10^-308 they have fewer digits, and the room has another shape.";
    axis.ordinary = 1.0;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-300, 300, 15);
    for (const double k : {-323.0, -322.0, -320.0, -318.0, -316.0, -312.0, -308.0, 305.0, 307.0, 308.0})
        axis.values.push_back(std::pow(10.0, k));
    for (const double k :
         {-20.0, -12.0, -9.0, -6.0, -3.0, -1.0, 1.0, 3.0, 6.0, 9.0, 12.0, 20.0, 40.0, -40.0})
        axis.values.push_back(std::pow(10.0, k));
    std::ranges::sort(axis.values);
    axis.methods = leave_methods(scaled);
    axis.shared_truth = true;
    const auto ref = [](double) { return bound_in_tetrahedron(Format::binary64, tetrahedron_extent); };
    const auto host = [](double) { return bound_in_tetrahedron(Format::binary32, tetrahedron_extent); };
    const std::string above = "a coordinate of the file, up to 1.15 times the radius, must be a double: "
                              "the largest one is 1.8 10^308";
    const std::string below = "the coordinates of the file are multiples of 4.9 10^-324, the smallest "
                              "double: at a radius of a hundred of them the walls are still where they "
                              "were meant to be, within 1%";
    axis.limits = {{"ref", 1.5e308, ref, 1.79e308, Failure::refused, above},
                   {"host", 1.5e308, host, 1.79e308, Failure::refused, above},
                   {"ref", 5e-322, ref, 5e-324, Failure::missed, below},
                   {"host", 5e-322, host, 5e-324, Failure::missed, below}};
    axis.derivation =
        "both programs multiply the scene by a power of two, which rounds nothing, so the bound is that "
        "of a room of size 1 (`extremes/leave/tetrahedron.h`).";
    return axis;
}

} // namespace extremes
