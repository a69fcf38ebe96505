// Light that leaves a surface, or arrives at it, at a small angle.

#include "extremes/axes/axes.h"
#include "extremes/leave/bound.h"
#include "extremes/leave/leave_case.h"
#include "extremes/leave/shapes.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace extremes {

namespace {

constexpr double grazing_extent = 3.5; // of the scenes below along any axis

/// A floor in the plane z = 0, before it is turned: an equilateral triangle with corners at
/// distance 1.5.
void add_floor(scenes::Scene& scene, const Turn& turn)
{
    std::array<scenes::Vec3, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double phi = 2.0 * std::numbers::pi * static_cast<double>(i) / 3.0;
        corners[i] = turn(1.5 * scenes::Vec3(std::cos(phi), std::sin(phi), 0.0));
    }
    scene.triangles.push_back({corners, 0});
}

scenes::Vec3 on_floor(Random& random)
{
    return {random.between(-0.4, 0.0), random.between(-0.2, 0.2), 0.0};
}

/// Light comes from above and goes on along the floor, at the angle `parameter` (radians) to it, towards
/// a wall that stands on the floor. Below the floor, farther back, is another wall.
LeaveCase leaving_flat(double parameter, Random& random, int rays)
{
    LeaveCase result{grey_scene(), {}, 1.0};
    const Turn turn = random_turn(random);
    add_floor(result.scene, turn);
    const auto wall = [&](double x, double top) {
        result.scene.triangles.push_back(
            {{turn(scenes::Vec3(x, -1.5, 0.0)), turn(scenes::Vec3(x, 1.5, 0.0)),
              turn(scenes::Vec3(x, 0.0, top))},
             0});
    };
    wall(0.5, 1.5);
    wall(0.7, -1.5);
    for (int i = 0; i < rays; ++i) {
        const scenes::Vec3 from = on_floor(random);
        const scenes::Vec3 origin(random.between(-0.4, 0.0), random.between(-0.4, 0.4), 0.6);
        const scenes::Vec3 onward(std::cos(parameter), 0.0, std::sin(parameter));
        result.rays.push_back(
            {turn(origin), direction_between(turn(origin), turn(from)), 0, turn(onward)});
    }
    return result;
}

/// Light arrives at the floor at the angle `parameter` (radians), and goes on upwards to a sloping
/// ceiling.
LeaveCase arriving_flat(double parameter, Random& random, int rays)
{
    LeaveCase result{grey_scene(), {}, 1.0};
    const Turn turn = random_turn(random);
    add_floor(result.scene, turn);
    result.scene.triangles.push_back(
        {{turn(scenes::Vec3(-1.5, -1.5, 0.6)), turn(scenes::Vec3(1.5, -1.5, 1.2)),
          turn(scenes::Vec3(0.0, 1.5, 0.8))},
         0});
    for (int i = 0; i < rays; ++i) {
        const scenes::Vec3 from = on_floor(random);
        const scenes::Vec3 back(-std::cos(parameter), 0.0, std::sin(parameter));
        const scenes::Vec3 onward(random.between(-0.2, 0.2), random.between(-0.2, 0.2), 1.0);
        const scenes::Vec3 origin = turn(from + 0.4 * back);
        result.rays.push_back({origin, turn(-back), 0, glm::normalize(turn(onward))});
    }
    return result;
}

// The wall stands upright; light that goes along the floor meets it with a cosine near 1 from an angle
// of 60 degrees on, and arrives at the floor at 45 degrees or more.
double bound_of_leaving_flat(Format format)
{
    return bound_of_leaving(format, grazing_extent, grazing_extent, 0.5, 0.5);
}

// The ceiling slopes by less than 25 degrees, the light goes up within 16 degrees: cosine at least 0.7.
double bound_of_arriving_flat(Format format, double angle)
{
    return bound_of_leaving(format, grazing_extent, grazing_extent, 0.7, std::sin(angle));
}

} // namespace

Axis grazing_axis()
{
    Axis axis;
    axis.number = 6;
    axis.name = "grazing";
    axis.title = "Light that leaves at a small angle";
    axis.parameter = "angle between the light and the surface, in radians";
    axis.about =
        "Light meets a floor from above and goes on along it at a small angle, to a wall that stands on "
        "the floor. Light that gets below the floor finds another wall. The error is that of the "
        "distance "
        "between the two points, relative to the size of the floor. The truth follows exactly from the "
        "coordinates and directions, which are doubles.";
    axis.ordinary = 0.1;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-20, -1, 0.5);
    axis.methods = leave_methods(leaving_flat);
    axis.shared_truth = true;
    const std::string because =
        "a computed normal, and a direction, are off by about one unit in the last "
        "place: below that angle it is not known to which side the light goes";
    // Normal of an equilateral triangle: two differences with 1 rounding each, a cross product with 3
    // and a normalisation with 4 roundings per coordinate, relative to products of about 1: 9 sqrt(3) u
    // < 16 u. The direction carries u; the floor's and the wall's corners, and for the fast path all its
    // input, carry u M sqrt(3) each, at a distance of at least 0.5: 4 sqrt(3) 1.75 u / 0.5 < 25 u. Sum:
    // 42 u.
    axis.limits = {{"ref", 42 * 0x1p-53, [](double) { return bound_of_leaving_flat(Format::binary64); },
                    2e-17, Failure::leaked, because},
                   {"host", 42 * 0x1p-24, [](double) { return bound_of_leaving_flat(Format::binary32); },
                    1e-8, Failure::leaked, because}};
    axis.derivation =
        "the normal of an equilateral triangle carries 9 roundings per coordinate, less than 16 u in "
        "all; "
        "corners and directions move the floor and the foot of the wall by less than 25 u against each "
        "other; together 42 u. The bound on the error: `extremes/leave/bound.h`.";
    return axis;
}

Axis grazing_hit_axis()
{
    Axis axis = grazing_axis();
    axis.name = "grazing-hit";
    axis.title = "Light that arrives at a small angle";
    axis.about = "Light arrives at a floor at a small angle, and goes on upwards to a sloping ceiling. "
                 "The error is "
                 "that of the distance between the two points, relative to the size of the floor. The "
                 "truth follows "
                 "exactly from the coordinates and directions, which are doubles.";
    axis.methods = leave_methods(arriving_flat);
    axis.shared_truth = true;
    const std::string because = "an error of the height moves the meeting point by that error over the "
                                "angle: there it is 1% of the scene";
    axis.limits = {{"ref", 1e-12, [](double x) { return bound_of_arriving_flat(Format::binary64, x); },
                    1e-16, Failure::missed, because},
                   {"host", 1e-3, [](double x) { return bound_of_arriving_flat(Format::binary32, x); },
                    1e-7, Failure::missed, because}};
    axis.derivation = "`extremes/leave/bound.h`, with the sine of the angle as the first cosine. At the "
                      "limit the bound is about 1%.";
    return axis;
}

} // namespace extremes
