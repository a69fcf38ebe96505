// A triangle much smaller than its scene.

#include "extremes/axes/axes.h"
#include "extremes/leave/bound.h"
#include "extremes/leave/tetrahedron.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace extremes {

namespace {

/// A room as in tetrahedron_case, and in its middle an equilateral triangle whose corners are at the
/// distance `parameter` from its centre. No wall is nearer to the middle than 0.07. Light meets the
/// small triangle and goes on to a wall.
LeaveCase small_triangle(double parameter, Random& random, int rays)
{
    LeaveCase result = tetrahedron_case(random, 0, 1.0, [](const scenes::Vec3& v) { return v; });
    const Turn turn = random_turn(random);
    const scenes::Vec3 middle = 0.01 * random.direction();
    std::array<scenes::Vec3, 3> corners{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double phi = 2.0 * std::numbers::pi * static_cast<double>(i) / 3.0;
        corners[i] = middle + parameter * turn(scenes::Vec3(std::cos(phi), std::sin(phi), 0.0));
    }
    const auto small = static_cast<std::uint32_t>(result.scene.triangles.size());
    result.scene.triangles.push_back({corners, 0});
    const auto slanted = [&] { // at most 72 degrees from the normal, on either side
        for (;;)
            if (const scenes::Vec3 d = random.direction(); std::abs(glm::dot(d, turn.z)) > 0.32)
                return d;
    };
    while (static_cast<int>(result.rays.size()) < rays) {
        const scenes::Vec3 from = weighted(corners, random_weights<3>(random, 0.1));
        const scenes::Vec3 origin = middle + 0.05 * slanted();
        const LeaveRay ray{origin, direction_between(origin, from), small, slanted()};
        // The wall that the light goes to, by the plane that is nearest: a margin to its edges.
        bool clear = true;
        double nearest = 1e9;
        double cosine = 0.0;
        for (std::size_t wall = 0; wall < 4; ++wall) {
            const auto& v = result.scene.triangles[wall].vertices;
            const scenes::Vec3 n = glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
            const double slope = glm::dot(n, ray.onward);
            const double t = glm::dot(v[0] - middle, n) / slope;
            if (!(t > 0.0)) continue;
            clear = clear && std::abs(t - nearest) > 0.02;
            if (t >= nearest) continue;
            nearest = t;
            cosine = std::abs(slope);
        }
        if (clear && cosine > least_cosine + 0.01) result.rays.push_back(ray);
    }
    return result;
}

double bound_from_small(Format format)
{
    return bound_of_leaving(format, tetrahedron_extent, tetrahedron_extent, least_cosine, 0.3);
}

} // namespace

Axis area_axis()
{
    Axis axis;
    axis.number = 4;
    axis.name = "area";
    axis.title = "A triangle much smaller than its scene";
    axis.parameter = "radius of the triangle, in radii of the scene";
    axis.about =
        "In the middle of a closed room is a small triangle. Light meets it and goes on to a wall. The "
        "error is that of the distance between the two points, relative to the room's radius. The truth "
        "follows exactly from the coordinates of the file, which are doubles. (For a whole scene of "
        "small "
        "areas see scale: a scene of any size is brought to size 1.)";
    axis.ordinary = 0.01;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-18, -2, 0.5);
    axis.methods = leave_methods(small_triangle);
    axis.shared_truth = true;
    const std::string because =
        "rounding moves the ray and the triangle against each other by more than the triangle's width";
    // A ray that is aimed at a weight of 0.1 or more passes the edges at 0.1 times the height, 1.5 s, or
    // more, within the plane. It is moved there by 7 sqrt(3) u a / d (bound.h, step 1); for the fast
    // path, by sqrt(3) (2 M + sqrt(3) a) u / d more (step 5), M <= a. With a = 2.3 and d = 0.3: 93 u and
    // 143 u altogether, over 0.15 s.
    axis.limits = {
        {"ref", 93 * 0x1p-53 / 0.15, [](double) { return bound_from_small(Format::binary64); }, 1e-17,
         Failure::missed, because},
        {"host", 143 * 0x1p-24 / 0.15, [](double) { return bound_from_small(Format::binary32); }, 1e-7,
         Failure::missed, because}};
    axis.derivation =
        "within the plane of the small triangle a ray moves by at most 93 u (143 u for the fast path, "
        "which rounds its input); rays are aimed at 0.15 radii of the triangle or more from its edges.";
    return axis;
}

} // namespace extremes
