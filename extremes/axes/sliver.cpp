// Needles: triangles much longer than wide.

#include "extremes/axes/axes.h"
#include "extremes/leave/bound.h"
#include "extremes/leave/leave_case.h"
#include "extremes/leave/shapes.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace extremes {

namespace {

constexpr double needle_cosine = 0.3;
constexpr double tube_extent = 2.0; // length 1 and twice the greatest width 0.5, along any axis

/// A tube of six needles: of length 1, its cross-section a triangle.
struct Tube {
    std::array<std::array<scenes::Vec3, 3>, 2> ends; // three corners at each end

    /// The point of a side (from corner `side` to the next one) at the share `along` of the length and
    /// the share `across` of the side.
    [[nodiscard]] scenes::Vec3 on_side(std::size_t side, double along, double across) const
    {
        const std::size_t next = (side + 1) % 3;
        return (1 - along) * ((1 - across) * ends[0][side] + across * ends[0][next]) +
               along * ((1 - across) * ends[1][side] + across * ends[1][next]);
    }
    [[nodiscard]] scenes::Vec3 normal_of_side(std::size_t side, const scenes::Vec3& axis) const
    {
        return glm::normalize(glm::cross(axis, ends[0][(side + 1) % 3] - ends[0][side]));
    }
};

/// A place across a side that is 0.1 off its edges, and off the diagonal that divides it into needles.
double place_across(Random& random, double along)
{
    for (;;)
        if (const double across = random.between(0.1, 0.9); std::abs(across - along) > 0.1)
            return across;
}

/// A tube whose walls are `parameter` times as long as wide. Rays from inside meet a wall, and the light
/// goes on to another wall; both directions are across the tube.
LeaveCase tube_case(double parameter, Random& random, int rays)
{
    const double width = 0.5 / parameter; // of the cross-section: the radius of its corners
    LeaveCase result{grey_scene(), {}, width};
    const Turn turn = random_turn(random);
    Tube tube{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double phi =
            2.0 * std::numbers::pi * (static_cast<double>(i) + random.between(-0.1, 0.1)) / 3.0;
        for (std::size_t end = 0; end < 2; ++end)
            tube.ends[end][i] =
                turn(scenes::Vec3(end == 0 ? -0.5 : 0.5, width * std::cos(phi), width * std::sin(phi)));
    }
    const auto& [near, far] = tube.ends;
    for (std::size_t side = 0; side < 3; ++side) {
        const std::size_t next = (side + 1) % 3;
        result.scene.triangles.push_back({{near[side], near[next], far[next]}, 0}); // across > along
        result.scene.triangles.push_back({{near[side], far[next], far[side]}, 0});
    }
    while (static_cast<int>(result.rays.size()) < rays) {
        const double along = random.between(0.2, 0.8);
        const std::size_t start = random.below(3);
        const std::size_t target = (start + 1 + random.below(2)) % 3;
        const double across = place_across(random, along);
        const scenes::Vec3 from = tube.on_side(start, along, across);
        const scenes::Vec3 to = tube.on_side(target, along, place_across(random, along));
        LeaveRay ray{};
        const auto inside = random_weights<3>(random, 0.1);
        for (std::size_t i = 0; i < 3; ++i) ray.origin += inside[i] * tube.on_side(i, along, 0.0);
        ray.start = static_cast<std::uint32_t>(2 * start + (across > along ? 0 : 1));
        if (ray.origin == from || from == to) { // rounded away: the ray meets nothing
            ray.direction = ray.onward = turn.x;
            result.rays.push_back(ray);
            continue;
        }
        ray.direction = direction_between(ray.origin, from);
        ray.onward = direction_between(from, to);
        const auto cosine = [&](std::size_t side, const scenes::Vec3& d) {
            return std::abs(glm::dot(tube.normal_of_side(side, turn.x), d));
        };
        if (cosine(start, ray.direction) > needle_cosine + 0.05 &&
            cosine(target, ray.onward) > needle_cosine + 0.05)
            result.rays.push_back(ray);
    }
    return result;
}

/// Relative to the width, 0.5 / aspect. The scene is placed with its centre within half a diagonal of
/// the origin, so that no coordinate exceeds its extent.
double bound_of_needles(Format format, double aspect)
{
    return bound_of_leaving(format, tube_extent, tube_extent, needle_cosine, needle_cosine) * aspect /
           0.5;
}

} // namespace

Axis sliver_axis()
{
    Axis axis;
    axis.number = 4;
    axis.name = "sliver";
    axis.title = "Needles";
    axis.parameter = "length of the triangles over twice their width";
    axis.about =
        "A tube of six needles, turned at random. A ray from inside meets a wall, and the light goes on "
        "across the tube to another wall. The error is that of the distance between the two points, "
        "relative to the tube's radius. The truth follows exactly from the coordinates of the file, "
        "which "
        "are doubles.";
    axis.ordinary = 1.0;
    axis.logarithmic = true;
    axis.values = powers_of_ten(0, 17, 0.5);
    axis.methods = leave_methods(tube_case);
    axis.shared_truth = true;
    const std::string because = "coordinates are rounded in proportion to the length of a needle, and "
                                "errors count in proportion "
                                "to its width";
    axis.limits = {{"ref", 2.5e10, [](double x) { return bound_of_needles(Format::binary64, x); }, 1e14,
                    Failure::inaccurate, because},
                   {"host", 40, [](double x) { return bound_of_needles(Format::binary32, x); }, 1e5,
                    Failure::inaccurate, because}};
    axis.derivation =
        "the roundings of both rays are counted in `extremes/leave/bound.h`; relative to the "
        "width they grow in proportion to the aspect. At the limit the bound is 1%.";
    return axis;
}

} // namespace extremes
