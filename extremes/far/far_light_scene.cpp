#include "extremes/far/far_light_scene.h"
#include "extremes/grey_scene.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace extremes {

FarLight far_light(double distance, Random& random)
{
    FarLight far;
    const scenes::Vec3 up = random.direction();
    const scenes::Vec3 x = glm::normalize(glm::cross(up, random.direction()));
    const scenes::Vec3 y = glm::cross(up, x);
    const double half = 0.5 / std::sqrt(2.0);
    const auto corner = [&](double a, double b) { return half * (a * x + b * y); };
    far.scene = grey_scene();
    far.scene.triangles = {{{corner(-1, -1), corner(1, -1), corner(-1, 1)}, 0},
                           {{corner(1, 1), corner(-1, 1), corner(1, -1)}, 0}};
    const scenes::Sphere sphere{0.1 * up, 0.05, 0};
    far.scene.spheres = {sphere};
    const double cosine = random.between(least_far_cosine, 1.0);
    const double phi = random.between(0, 6.28);
    const scenes::Vec3 to_light =
        cosine * up + std::sqrt(1 - cosine * cosine) * (std::cos(phi) * x + std::sin(phi) * y);
    const scenes::Vec3 light = distance * to_light;
    far.scene.point_lights = {{light, scenes::Rgb(distance * distance)}};

    while (far.points.size() < points_of_far_light) {
        FarLight::OnFloor point{static_cast<std::uint32_t>(random.below(2)), random.uniform(), 0, true,
                                0};
        point.b2 = (1 - point.b1) * random.uniform();
        const auto& v = far.scene.triangles[point.triangle].vertices;
        const ExactVec3 e1 = ExactVec3(v[1]) - ExactVec3(v[0]);
        const ExactVec3 e2 = ExactVec3(v[2]) - ExactVec3(v[0]);
        const ExactVec3 p = ExactVec3(v[0]) + Exact(point.b1) * e1 + Exact(point.b2) * e2;
        const ExactVec3 d = ExactVec3(light) - p;
        const Exact d2 = dot(d, d);
        // The shadow of the sphere; points at its edge are left out.
        const ExactVec3 off = cross(ExactVec3(sphere.center) - p, d);
        const double miss = sqrt(dot(off, off) / d2).to_double() / sphere.radius;
        if (std::abs(miss - 1) < 1e-3) continue;
        point.lit = miss > 1;
        const ExactVec3 n = cross(e1, e2);
        point.irradiance = Exact(distance) * distance * dot(n, d) / (d2 * sqrt(d2 * dot(n, n)));
        far.points.push_back(point);
    }
    return far;
}

} // namespace extremes
