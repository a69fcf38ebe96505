#include "extremes/far/far_eye.h"
#include "extremes/grey_scene.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <utility>

namespace extremes {

namespace {

/// Two unit vectors that make a frame with the unit vector `z`.
std::pair<scenes::Vec3, scenes::Vec3> axes_across(const scenes::Vec3& z, Random& random)
{
    const scenes::Vec3 x = glm::normalize(glm::cross(z, random.direction()));
    return {x, glm::cross(z, x)};
}

void add_far_sphere(FarEye& far, const scenes::Vec3& to_eye, Random& random)
{
    const scenes::Sphere sphere{0.1 * random.direction(), 0.5 / std::sqrt(3.0), 0};
    far.scene.spheres = {sphere};
    const auto [x, y] = axes_across(to_eye, random);
    for (int i = 0; i < rays_of_far_eye; ++i) {
        const double sine = far_sphere_sine * std::sqrt(random.uniform());
        const double phi = random.between(0, 6.28);
        const scenes::Vec3 across = std::cos(phi) * x + std::sin(phi) * y;
        const ExactVec3 normal(std::sqrt(1 - sine * sine) * to_eye + sine * across);
        far.targets.push_back(ExactVec3(sphere.center) +
                              (Exact(sphere.radius) / length(normal)) * normal);
    }
}

void add_far_cube(FarEye& far, const scenes::Vec3& to_eye, Random& random)
{
    const scenes::Vec3 z = random.direction();
    const auto [x, y] = axes_across(z, random);
    const scenes::Vec3 center = 0.1 * random.direction();
    const double half = 0.5 / std::sqrt(3.0);
    double best = 0;
    for (const scenes::Vec3& normal : {x, -x, y, -y, z, -z}) {
        const auto [u, v] = normal == x || normal == -x   ? std::pair(y, z)
                            : normal == y || normal == -y ? std::pair(z, x)
                                                          : std::pair(x, y);
        const auto corner = [&, u = u, v = v](double a, double b) {
            return center + half * (normal + a * u + b * v);
        };
        const auto first = far.scene.triangles.size();
        far.scene.triangles.push_back({{corner(-1, -1), corner(1, -1), corner(-1, 1)}, 0});
        far.scene.triangles.push_back({{corner(1, 1), corner(-1, 1), corner(1, -1)}, 0});
        if (glm::dot(normal, to_eye) <= best) continue; // of all faces the one that faces the eye
        best = glm::dot(normal, to_eye);
        far.targets.clear();
        for (int i = 0; i < rays_of_far_eye; ++i) {
            const auto& p = far.scene.triangles[first + random.below(2)].vertices;
            const double b1 = random.between(0.05, 0.9);
            const double b2 = random.between(0.05, 0.95 - b1);
            far.targets.push_back(ExactVec3(p[0]) + Exact(b1) * (ExactVec3(p[1]) - ExactVec3(p[0])) +
                                  Exact(b2) * (ExactVec3(p[2]) - ExactVec3(p[0])));
        }
    }
}

} // namespace

FarEye far_eye(double distance, Random& random)
{
    FarEye far;
    const scenes::Vec3 to_eye = random.direction();
    far.scene = grey_scene();
    far.scene.camera = scenes::Camera{distance * to_eye,           {1, 0, 0}, {0, 1, 0}, {0, 0, 1},
                                      scenes::FovAxis::horizontal, 1};
    if (random.sign() > 0)
        add_far_cube(far, to_eye, random);
    else
        add_far_sphere(far, to_eye, random);
    return far;
}

} // namespace extremes
