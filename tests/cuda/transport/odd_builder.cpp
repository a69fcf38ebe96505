#include "tests/cuda/transport/odd_builder.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <sstream>
#include <variant>

namespace fast_transport_test {

using scenes::Rgb;
using scenes::Vec3;

OddBuilder::OddBuilder(std::uint32_t seed) : random_(seed)
{
    exact_ = chance(0.3);
    if (exact_) {
        say("exact frame");
    } else {
        z_ = any_direction();
        x_ = glm::normalize(glm::cross(any_direction(), z_));
        y_ = glm::cross(z_, x_);
        size_ = std::exp2(any(-3, 3));
        origin_ = 4 * size_ * Vec3{any(-1, 1), any(-1, 1), any(-1, 1)};
    }
    if (!exact_ && chance(0.1)) {
        size_ = any_size(1e-30, 1e30); // so that products of densities exceed the range of doubles
        origin_ = any_size(1, 1e4) * size_ * any_direction();
        say("unit of length", size_);
        say("distance from the origin", glm::length(origin_));
    }
    if (chance(0.1)) {
        brightness_ = any_size(1e-6, 1e6);
        say("brightness", brightness_);
    }
}

double OddBuilder::any(double low, double high)
{
    return low + (high - low) * ((static_cast<double>(random_()) + 0.5) * 0x1p-32);
}

double OddBuilder::any_size(double low, double high)
{
    return std::exp(any(std::log(low), std::log(high)));
}

Rgb OddBuilder::any_colour(double low, double high)
{
    Rgb colour{any(low, high), any(low, high), any(low, high)};
    if (chance(0.05)) colour[pick(3)] = 0; // black in one channel or in two
    if (chance(0.05)) colour[pick(3)] = 0;
    return colour;
}

Vec3 OddBuilder::any_direction()
{
    const double z = any(-1, 1);
    const double angle = any(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

Vec3 OddBuilder::place(const Vec3& p) const
{
    return origin_ + size_ * turn(p);
}

Vec3 OddBuilder::turn(const Vec3& w) const
{
    return w.x * x_ + w.y * y_ + w.z * z_;
}

std::uint32_t OddBuilder::add_material(const scenes::Material& material, const std::string& name)
{
    scenes::Material placed = material;
    if (auto* emission = std::get_if<scenes::Emission>(&placed)) emission->radiance *= brightness_;
    for (scenes::Scene* scene : {&plain_, &full_}) { // the numbers are the same in both
        scene->materials.push_back(placed);
        scene->material_names.push_back(name);
    }
    return static_cast<std::uint32_t>(full_.materials.size() - 1);
}

void OddBuilder::add_triangle(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t material)
{
    each([&](scenes::Scene& scene) {
        scene.triangles.push_back({{place(a), place(b), place(c)}, material});
    });
}

void OddBuilder::add_quad(const Vec3& p, const Vec3& a, const Vec3& b, std::uint32_t material)
{
    add_triangle(p, p + a, p + a + b, material);
    add_triangle(p, p + a + b, p + b, material);
}

void OddBuilder::add_box(const Vec3& low, const Vec3& high, std::uint32_t material, bool outwards,
                         int without)
{
    const auto corner = [&](int bits) {
        return Vec3((bits & 1) != 0 ? high.x : low.x, (bits & 2) != 0 ? high.y : low.y,
                    (bits & 4) != 0 ? high.z : low.z);
    };
    for (int face = 0; face < 6; ++face) {
        if (face == without) continue;
        const int axis = face / 2;
        const int a = 1 << (axis + 1) % 3;
        const int b = 1 << (axis + 2) % 3;
        const int first = (face % 2) << axis;
        // From the first corner, a x b points along the axis: outwards for the high face.
        const bool turned = (face % 2 == 1) != outwards;
        const int second = first | (turned ? b : a);
        const int fourth = first | (turned ? a : b);
        const int third = first | a | b;
        add_triangle(corner(first), corner(second), corner(third), material);
        add_triangle(corner(first), corner(third), corner(fourth), material);
    }
}

void OddBuilder::add_sphere(const Vec3& center, double radius, std::uint32_t material)
{
    each([&](scenes::Scene& scene) {
        scene.spheres.push_back({place(center), size_ * radius, material});
    });
}

void OddBuilder::add_point_light(const Vec3& p, const Rgb& intensity)
{
    each([&](scenes::Scene& scene) {
        scene.point_lights.push_back({place(p), brightness_ * size_ * size_ * intensity});
    });
}

void OddBuilder::add_spot_light(const Vec3& p, const Vec3& w, const Rgb& intensity, double cos_cutoff,
                                double exponent)
{
    each([&](scenes::Scene& scene) {
        scene.spot_lights.push_back({place(p), glm::normalize(turn(w)),
                                     brightness_ * size_ * size_ * intensity, cos_cutoff, exponent});
    });
}

void OddBuilder::add_sun(const Vec3& w, const Rgb& irradiance)
{
    each([&](scenes::Scene& scene) {
        scene.directional_lights.push_back({glm::normalize(turn(w)), brightness_ * irradiance});
    });
}

void OddBuilder::set_sky(const Rgb& radiance)
{
    each([&](scenes::Scene& scene) { scene.environment = brightness_ * radiance; });
}

void OddBuilder::look(const Vec3& from, const Vec3& along, double roll, double fov)
{
    const Vec3 backward = -glm::normalize(turn(along));
    // A vector at right angles to it; exactly along an axis where it is itself along an axis.
    const Vec3 helper = std::abs(glm::dot(backward, z_)) < 0.9 ? z_ : y_;
    const Vec3 right = glm::normalize(glm::cross(helper, backward));
    const Vec3 up = glm::cross(backward, right);
    const Vec3 rolled = roll == 0 ? right : std::cos(roll) * right + std::sin(roll) * up;
    const auto axis = chance(0.5) ? scenes::FovAxis::horizontal : scenes::FovAxis::vertical;
    each([&](scenes::Scene& scene) {
        scene.camera =
            scenes::Camera{place(from), rolled, glm::cross(backward, rolled), backward, axis, fov};
    });
}

void OddBuilder::say(const std::string& what, double number)
{
    std::ostringstream text;
    text.precision(3);
    text << what << ' ' << number;
    say(text.str());
}

} // namespace fast_transport_test
