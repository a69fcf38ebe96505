// Two surfaces at a small distance.

#include "extremes/axes/axes.h"
#include "extremes/leave/bound.h"
#include "extremes/leave/leave_case.h"
#include "extremes/leave/shapes.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace extremes {

namespace {

constexpr double gap_extent = 3.0; // along any axis, the origins of rays included
constexpr double gap_cosine = 0.5;

/// Two equal triangles, one above the other by `parameter`. Light comes from below, passes the first and
/// goes on to the second, at up to 60 degrees to the normal.
LeaveCase gap_case(double parameter, Random& random, int rays)
{
    LeaveCase result{grey_scene(), {}, 1.0};
    const Turn turn = random_turn(random);
    const double corner = 1.0; // distance from the middle
    for (const double height : {0.0, parameter}) {
        std::array<scenes::Vec3, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const double phi = 2.0 * std::numbers::pi * static_cast<double>(i) / 3.0;
            corners[i] = turn(scenes::Vec3(corner * std::cos(phi), corner * std::sin(phi), height));
        }
        result.scene.triangles.push_back({corners, 0});
    }
    const auto upwards = [&] {
        const double phi = 2.0 * std::numbers::pi * random.uniform();
        const double cosine = random.between(gap_cosine + 0.01, 1.0);
        const double sine = std::sqrt(1.0 - cosine * cosine);
        return turn(scenes::Vec3(sine * std::cos(phi), sine * std::sin(phi), cosine));
    };
    for (int i = 0; i < rays; ++i) {
        const double r = 0.3 * std::sqrt(random.uniform());
        const double phi = 2.0 * std::numbers::pi * random.uniform();
        const scenes::Vec3 from = turn(scenes::Vec3(r * std::cos(phi), r * std::sin(phi), 0.0));
        const scenes::Vec3 origin = from - 0.6 * upwards();
        // At an ordinary gap light must not pass beside the second triangle, whose inner radius is 0.5.
        scenes::Vec3 onward = upwards();
        while (parameter > 0.05 && glm::dot(onward, turn.z) < 0.9) onward = upwards();
        result.rays.push_back({origin, direction_between(origin, from), 0, onward});
    }
    return result;
}

double bound_of_gap(Format format)
{
    return bound_of_leaving(format, gap_extent, gap_extent, gap_cosine, gap_cosine);
}

} // namespace

Axis gap_axis()
{
    Axis axis;
    axis.number = 7;
    axis.name = "gap";
    axis.title = "Two surfaces at a small distance";
    axis.parameter = "distance between two triangles, in their radius";
    axis.about =
        "Light comes from below, passes a triangle, as if it were of glass, and goes on to a second "
        "one, "
        "parallel to it at a small distance. The error is that of the distance between the two points, "
        "relative to the radius of the triangles. If the light starts beyond the second triangle, it "
        "has "
        "leaked. The truth follows exactly from the coordinates, which are doubles.";
    axis.ordinary = 0.1;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-18, -1, 0.5);
    axis.methods = leave_methods(gap_case);
    axis.shared_truth = true;
    const std::string because = "light starts at a distance from the surface that covers all roundings "
                                "there: where the gap is smaller, it starts beyond the second surface";
    // Steps 1 to 3 of bound.h, along the normal alone: the computed position is off by sqrt(3) (7 a + M)
    // u, the offset is at most sqrt(3) (15 a + 2 M) u and is rounded by sqrt(3) M u. a: the extent of a
    // triangle, at most 2; M: the largest coordinate after placing, at most 3. Sum: sqrt(3) (22 * 2 + 4
    // * 3) u < 97 u. The corners of both triangles are rounded by the file or by the fast path: 2
    // sqrt(3) 3 u < 11 u. The second ray finds only what is certainly before it: its perturbations, 7
    // sqrt(3) 2 u < 25 u. And surfaces closer than 32 u M, or 4 u M in single precision, count as one.
    // Sum: 133 u.
    axis.limits = {{"ref", 133 * 0x1p-53, [](double) { return bound_of_gap(Format::binary64); }, 1e-15,
                    Failure::leaked, because},
                   {"host", 133 * 0x1p-24, [](double) { return bound_of_gap(Format::binary32); }, 3e-7,
                    Failure::leaked, because}};
    axis.derivation =
        "with a the extent and M the largest coordinate, the position is off the plane by less than "
        "1.74 (7 a + M) u, the offset is at most 1.74 (15 a + 2 M) u; with the roundings of corners and "
        "of "
        "the second ray that is less than 133 u for triangles of radius 1. Exactly coincident surfaces "
        "are "
        "decided by rule ([contacts.md](../contacts.md)).";
    return axis;
}

} // namespace extremes
