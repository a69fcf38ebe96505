// The scene stands far away from the origin of its file.

#include "extremes/axes/axes.h"
#include "extremes/leave/tetrahedron.h"

namespace extremes {

namespace {

LeaveCase distant(double parameter, Random& random, int rays)
{
    const scenes::Vec3 offset = parameter * random.direction();
    return tetrahedron_case(random, rays, 1.0, [&](const scenes::Vec3& v) { return v + offset; });
}

// scenes::placed scales the diagonal of the box, at most sqrt(3) a, to less than 2 and at least 1, and
// leaves the box less than 1024 diagonals away from the origin: in multiples of the room's radius
constexpr double farthest_after_placing = 1025 * 1.7321 * tetrahedron_extent;

} // namespace

Axis distance_axis()
{
    Axis axis;
    axis.number = 2;
    axis.name = "distance";
    axis.title = "Distance from the origin";
    axis.parameter = "distance of the scene from the origin, in radii of the scene";
    axis.about = "A closed room of four triangles, far away in a random direction. A ray from inside "
                 "meets a wall, "
                 "and the light goes on to another wall. The error is that of the distance between the "
                 "two points, "
                 "relative to the room's radius. The truth follows exactly from the coordinates of the "
                 "file, which "
                 "are doubles.";
    axis.ordinary = 1.0;
    axis.logarithmic = true;
    axis.values = powers_of_ten(0, 16, 0.5);
    axis.methods = leave_methods(distant);
    axis.shared_truth = true;
    // Spacing of doubles at the largest coordinate, at most D + 1.15, over the diagonal, at least the
    // longest edge, which is 1.63 less twice sqrt(3) 0.15, or 1.1: below 1e-3 for D < 5.0e12. The scene
    // is refused for sure if the coordinate D / sqrt(3) over a diagonal of sqrt(3) 2.3 reaches it.
    const std::string because =
        "from there on neighbouring doubles are more than 10^-3 of the scene's diagonal apart, and the "
        "scene is refused: its shape is lost in the file";
    axis.limits = {
        {"ref", 4.9e12,
         [](double) { return bound_in_tetrahedron(Format::binary64, farthest_after_placing); }, 4e13,
         Failure::refused, because},
        {"host", 4.9e12,
         [](double) { return bound_in_tetrahedron(Format::binary32, tetrahedron_extent); }, 4e13,
         Failure::refused, because + ". Its own coordinates count from the middle of the scene"}};
    axis.derivation =
        "the roundings of both rays are counted in `extremes/leave/tetrahedron.h`. Both programs move "
        "the "
        "scene to the origin by an exact subtraction, so the bound does not depend on the distance.";
    return axis;
}

} // namespace extremes
