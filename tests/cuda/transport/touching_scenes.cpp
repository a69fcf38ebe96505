#include "tests/cuda/transport/touching_scenes.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace fast_transport_test {

namespace {

using scenes::Rgb;
using scenes::Vec3;

enum : std::uint32_t { wall, other_wall, lamp, second_lamp, glass, matte };

/// Builds a scene in the coordinates of the room, which is the cube from -1 to 1, and places it.
class Room {
public:
    explicit Room(std::uint32_t seed) : random_(seed)
    {
        const Vec3 z = glm::normalize(Vec3(any(-1, 1), any(-1, 1), any(0.2, 1)));
        x_ = glm::normalize(glm::cross(Vec3(any(0.5, 1), any(-0.3, 0.3), any(-0.3, 0.3)), z));
        z_ = z;
        y_ = glm::cross(z_, x_);
        origin_ = Vec3(any(-2, 2), any(-2, 2), any(-2, 2));
        size_ = std::exp2(any(-3, 3));
        scene_.materials = {scenes::Lambertian{colour()},
                            scenes::Lambertian{colour()},
                            scenes::Emission{5.0 * colour()},
                            scenes::Emission{2.0 * colour()},
                            scenes::Glass{Rgb(1.0), Rgb(1.0), any(1.3, 1.7)},
                            scenes::Lambertian{colour()}};
        scene_.material_names = {"wall", "other wall", "lamp", "second lamp", "glass", "matte"};
    }

    double any(double low, double high)
    {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    [[nodiscard]] Vec3 place(const Vec3& p) const
    {
        return origin_ + size_ * (p.x * x_ + p.y * y_ + p.z * z_);
    }
    [[nodiscard]] Vec3 turn(const Vec3& w) const { return w.x * x_ + w.y * y_ + w.z * z_; }

    /// The parallelogram p + a [0, 1] + b [0, 1], facing the direction a x b.
    void add(const Vec3& p, const Vec3& a, const Vec3& b, std::uint32_t material)
    {
        scene_.triangles.push_back({{place(p), place(p + a), place(p + a + b)}, material});
        scene_.triangles.push_back({{place(p), place(p + a + b), place(p + b)}, material});
    }
    /// An axis-aligned box, facing outwards or inwards.
    void add_box(const Vec3& low, const Vec3& high, std::uint32_t material, bool outwards)
    {
        const Vec3 d = high - low;
        const std::array<Vec3, 3> edge = {Vec3(d.x, 0, 0), Vec3(0, d.y, 0), Vec3(0, 0, d.z)};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Vec3& a = edge[(axis + 1) % 3];
            const Vec3& b = edge[(axis + 2) % 3];
            outwards ? add(low, b, a, material) : add(low, a, b, material);
            const Vec3 far = low + edge[axis];
            outwards ? add(far, a, b, material) : add(far, b, a, material);
        }
    }
    void add_point_light(const Vec3& p)
    {
        scene_.point_lights.push_back({place(p), size_ * size_ * 3.0 * colour()});
    }
    void add_spot_light(const Vec3& p, const Vec3& w)
    {
        scene_.spot_lights.push_back({place(p), glm::normalize(turn(w)), size_ * size_ * 6.0 * colour(),
                                      std::cos(any(0.6, 1.2)), any(0, 2)});
    }
    void add_sphere(const Vec3& p, double radius, std::uint32_t material)
    {
        scene_.spheres.push_back({place(p), size_ * radius, material});
    }
    void look(const Vec3& from, const Vec3& at)
    {
        const Vec3 backward = glm::normalize(turn(from - at));
        const Vec3 right = glm::normalize(glm::cross(turn(Vec3(0.1, 0.2, 1)), backward));
        scene_.camera = scenes::Camera{
            place(from),  right, glm::cross(backward, right), backward, scenes::FovAxis::horizontal,
            any(0.9, 1.3)};
    }
    void turn_over_last_two() // triangles: exchanges front and back
    {
        for (std::size_t i = scene_.triangles.size() - 2; i < scene_.triangles.size(); ++i)
            std::swap(scene_.triangles[i].vertices[1], scene_.triangles[i].vertices[2]);
    }
    [[nodiscard]] const scenes::Scene& scene() const { return scene_; }

private:
    Rgb colour() { return {any(0.3, 0.8), any(0.3, 0.8), any(0.3, 0.8)}; }

    std::mt19937 random_;
    Vec3 origin_, x_, y_, z_;
    double size_;
    scenes::Scene scene_;
};

} // namespace

scenes::Scene touching_scene(Touching kind, std::uint32_t seed, double gap)
{
    Room room(seed);
    room.add_box(Vec3(-1), Vec3(1), wall, false);
    room.add_box(Vec3(-0.6, -0.5, -0.9), Vec3(-0.2, 0.1, -0.4), other_wall, true);
    const double a = room.any(-0.7, 0.4);
    const double b = room.any(-0.7, 0.4);
    const Vec3 eye(room.any(0.5, 0.8), room.any(-0.8, -0.5), room.any(-0.2, 0.5));
    room.look(eye, Vec3(room.any(-0.3, 0), room.any(0, 0.3), room.any(-0.5, 0)));
    const auto lamp_below_ceiling = [&](double height, std::uint32_t material) {
        room.add(Vec3(a, b, height), Vec3(0, 0.5, 0), Vec3(0.4, 0, 0), material); // faces down
    };
    switch (kind) {
    case Touching::point_light_on_lamp:
        lamp_below_ceiling(0.6, lamp);
        room.add_point_light(Vec3(a + 0.17, b + 0.31, 0.6 - gap));
        break;
    case Touching::point_light_on_wall:
        room.add_point_light(Vec3(a, b, 1 - gap));
        break;
    case Touching::point_light_in_corner:
        room.add_point_light(Vec3(1 - gap, 1 - gap, 1 - gap));
        break;
    case Touching::point_light_on_sphere: {
        room.add_sphere(Vec3(0.3, 0.5, -0.5), 0.3, matte);
        const Vec3 w = glm::normalize(Vec3(room.any(-1, 0.2), room.any(-1, 0.2), room.any(0.2, 1)));
        room.add_point_light(Vec3(0.3, 0.5, -0.5) + (0.3 + gap) * w);
        break;
    }
    case Touching::spot_light_on_wall:
        room.add_spot_light(Vec3(a, b, 1 - gap), Vec3(room.any(-0.3, 0.3), room.any(-0.3, 0.3), -1));
        break;
    case Touching::eye_on_wall:
        lamp_below_ceiling(0.8, lamp);
        room.look(Vec3(1 - gap, eye.y, eye.z), Vec3(0, 0.1, -0.2));
        break;
    case Touching::eye_in_edge:
        lamp_below_ceiling(0.8, lamp);
        room.look(Vec3(1 - gap, -1 + gap, eye.z), Vec3(0, 0.1, -0.2));
        break;
    case Touching::lamp_in_wall:
        lamp_below_ceiling(1 - gap, lamp);
        break;
    case Touching::lamps_back_to_back:
        lamp_below_ceiling(0.4, lamp);
        lamp_below_ceiling(0.4 + gap, second_lamp);
        room.turn_over_last_two();
        break;
    case Touching::lamp_under_lamp:
        lamp_below_ceiling(0.7 - gap, lamp);
        room.add(Vec3(a - 0.1, b - 0.1, 0.7), Vec3(0, 0.5, 0), Vec3(0.4, 0, 0), second_lamp);
        break;
    case Touching::glass_on_floor: // with a gap it is sunk into the floor
        lamp_below_ceiling(0.8, lamp);
        room.add_box(Vec3(0.1, 0.1, -1 - gap), Vec3(0.6, 0.6, -0.5), glass, true);
        break;
    }
    return room.scene();
}

std::string name_of(Touching kind)
{
    constexpr std::array names = {"PointLightOnLamp",   "PointLightOnWall", "PointLightInCorner",
                                  "PointLightOnSphere", "SpotLightOnWall",  "EyeOnWall",
                                  "EyeInEdge",          "LampInWall",       "LampsBackToBack",
                                  "LampUnderLamp",      "GlassOnFloor"};
    return names[static_cast<std::size_t>(kind)];
}

} // namespace fast_transport_test
