#include "extremes/light/under_emitter.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace extremes {

UnderEmitter under_square(double size, Random& random)
{
    const auto any_frame = [&](const scenes::Vec3& z) {
        const scenes::Vec3 x = glm::normalize(glm::cross(z, random.direction()));
        return std::pair(x, glm::cross(z, x));
    };
    const auto within = [&](const scenes::Vec3& axis, double least) {
        const double cosine = random.between(least, 1.0);
        return cosine * axis + std::sqrt(1 - cosine * cosine) * any_frame(axis).first;
    };
    const scenes::Vec3 up = random.direction();
    const auto [east, north] = any_frame(up);
    const scenes::Vec3 middle = 0.1 * random.direction();
    const scenes::Vec3 towards = within(up, 0.5);
    const double distance = random.between(0.5, 0.85);
    const scenes::Vec3 normal = within(-towards, 0.5);
    const auto [right, above] = any_frame(normal);

    UnderEmitter under;
    scenes::Scene& scene = under.scene;
    scene.name = "emitter";
    scene.materials = {scenes::Lambertian{scenes::Rgb(albedo_under_emitter)},
                       scenes::Emission{scenes::Rgb(1 / (size * size))}};
    scene.material_names = {"floor", "lamp"};
    const auto add_square_at = [&](const scenes::Vec3& center, const scenes::Vec3& x,
                                   const scenes::Vec3& y, std::uint32_t material) {
        const auto corner = [&](double a, double b) { return center + a * x + b * y; };
        scene.triangles.push_back({{corner(-1, -1), corner(1, -1), corner(1, 1)}, material});
        scene.triangles.push_back({{corner(-1, -1), corner(1, 1), corner(-1, 1)}, material});
    };
    // Off the diagonal of the floor, where excluding one triangle would leave its neighbour.
    add_square_at(middle + 0.1 * east, 0.35 * east, 0.35 * north, 0);
    const scenes::Vec3 lamp = middle + distance * towards;
    add_square_at(lamp, 0.5 * size * right, 0.5 * size * above, 1);
    // The eye is on the other side of the vertical.
    const scenes::Vec3 backward = glm::normalize(up - 0.5 * (towards - glm::dot(towards, up) * up));
    const scenes::Vec3 to_right = glm::normalize(glm::cross(any_frame(backward).first, backward));
    scene.camera = scenes::Camera{middle + 0.6 * backward,        to_right,
                                  glm::cross(backward, to_right), backward,
                                  scenes::FovAxis::horizontal,    fov_of_emitter};
    // rho / pi L A cos cos' / d^2: of a point. The mean over the square differs by less than 8 size^2.
    under.radiance = albedo_under_emitter * std::numbers::inv_pi * glm::dot(towards, up) *
                     -glm::dot(towards, normal) / (distance * distance);
    return under;
}

} // namespace extremes
