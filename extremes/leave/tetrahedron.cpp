#include "extremes/leave/tetrahedron.h"

#include <cmath>
#include <numbers>

namespace extremes {

namespace {

std::array<scenes::Vec3, 3> face_of(const std::array<scenes::Vec3, 4>& v, std::size_t opposite)
{
    return {v[(opposite + 1) % 4], v[(opposite + 2) % 4], v[(opposite + 3) % 4]};
}

std::array<scenes::Vec3, 4> random_corners(Random& random)
{
    const double s = 1.0 / std::numbers::sqrt3;
    const Turn turn = random_turn(random);
    std::array<scenes::Vec3, 4> corners = {scenes::Vec3(s, s, s), scenes::Vec3(s, -s, -s),
                                           scenes::Vec3(-s, s, -s), scenes::Vec3(-s, -s, s)};
    for (scenes::Vec3& corner : corners) {
        const scenes::Vec3 moved(random.between(-0.15, 0.15), random.between(-0.15, 0.15),
                                 random.between(-0.15, 0.15));
        corner = turn(corner) + moved;
    }
    return corners;
}

} // namespace

LeaveCase tetrahedron_case(Random& random, int rays, double size,
                           const std::function<scenes::Vec3(const scenes::Vec3&)>& place)
{
    LeaveCase result{grey_scene(), {}, size};
    const std::array<scenes::Vec3, 4> shape = random_corners(random);
    std::array<scenes::Vec3, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) corners[i] = place(shape[i]);
    for (std::size_t i = 0; i < 4; ++i) result.scene.triangles.push_back({face_of(corners, i), 0});
    while (static_cast<int>(result.rays.size()) < rays) {
        // Weights, so that the same rays are meant wherever the room stands.
        const std::size_t start = random.below(4);
        const std::size_t target = (start + 1 + random.below(3)) % 4;
        const auto inside = random_weights<4>(random, 0.1);
        const auto on_start = random_weights<3>(random, 0.1);
        const auto on_target = random_weights<3>(random, 0.1);
        const auto ray_in = [&](const std::array<scenes::Vec3, 4>& v) {
            LeaveRay ray{};
            for (std::size_t i = 0; i < 4; ++i) ray.origin += inside[i] * v[i];
            const scenes::Vec3 from = weighted(face_of(v, start), on_start);
            const scenes::Vec3 to = weighted(face_of(v, target), on_target);
            if (from == ray.origin || from == to) return ray; // rounded away
            ray.direction = direction_between(ray.origin, from);
            ray.onward = direction_between(from, to);
            ray.start = static_cast<std::uint32_t>(start);
            return ray;
        };
        const LeaveRay meant = ray_in(shape);
        if (cosine_to_normal(face_of(shape, start), meant.direction) < least_cosine + 0.01 ||
            cosine_to_normal(face_of(shape, target), meant.onward) < least_cosine + 0.01)
            continue;
        LeaveRay ray = ray_in(corners);
        if (ray.direction == scenes::Vec3(0.0)) { // keeps the number of rays: this one meets nothing
            ray.direction = meant.direction;
            ray.onward = meant.onward;
        }
        result.rays.push_back(ray);
    }
    return result;
}

double bound_in_tetrahedron(Format format, double farthest)
{
    return bound_of_leaving(format, tetrahedron_extent, farthest, least_cosine, least_cosine);
}

} // namespace extremes
