// Furnaces: nothing absorbs, and all light has the radiance L. With any objects inside, the picture is
// L; in glass of index n it is n^2 L [Veach 1997, sec. 5.2].

#include "tests/cuda/transport/odd_scenes.h"
#include "tests/cuda/transport/odd_things.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fast_transport_test {

using scenes::Rgb;
using scenes::Vec3;

namespace {

/// A closed room of lamps of radiance `sky` around all cells, and more lamps that change nothing.
/// Returns whether light tracing has lamps that are hidden or far away, and therefore much noise.
bool add_walls_of_light(OddBuilder& builder, const Rgb& sky)
{
    const std::uint32_t lamp = builder.add_material(scenes::Emission{sky}, "lamp");
    bool odd = builder.chance(0.2);
    const double half = odd ? builder.any_size(2, largest_thing) : 1.5;
    if (odd) builder.say("walls far away", half);
    builder.add_box(Vec3(-half), Vec3(half), lamp, false);
    if (builder.chance(0.3)) {
        builder.say("lamps flush in the wall");
        for (int i = 0; i < 5; ++i)
            builder.add_quad(half * Vec3(0.1 * i - 0.5, -0.5, 1), half * Vec3(0, 1, 0),
                             half * Vec3(1, 0, 0), lamp);
    }
    if (builder.chance(0.3)) {
        const double power = builder.any_size(1, strongest_lamp);
        builder.say("lamp outside, power", power);
        odd = true;
        const bool flush = builder.chance(0.5); // in the plane of the wall, and facing away from it
        const Vec3 p = half * Vec3(-1, -1, flush ? 1 : 1.1);
        builder.add_quad(p, half * Vec3(2, 0, 0), half * Vec3(0, 2, 0),
                         builder.add_material(scenes::Emission{power * sky}, "lamp outside"));
    }
    return odd;
}

/// Returns the radiance of the picture, in units of that of the sky. `height`: the distance of the eye
/// from the nearest surface, if that is close.
double add_eye(OddBuilder& builder, const Vec3& cell, const Vec3& towards, Matter& matter,
               bool& light_sees, double& height)
{
    const double fov = builder.chance(0.2) ? builder.any_size(1e-4, 3.1) : builder.any(0.3, 2);
    if (fov < 0.1 || fov > 2) {
        builder.say("field of view", fov);
        light_sees = false;
        matter.cusps = false; // the picture could show only them
    }
    const double roll = builder.exact() ? 0 : builder.any(0, 6);
    const Vec3 along =
        builder.chance(0.4) ? Vec3(0, 0, towards.z > cell.z ? 1 : -1) : glm::normalize(towards - cell);
    if (builder.chance(0.25)) { // just above a block
        const double gap = builder.any_size(1e-6, 1e-2);
        builder.say("eye above a face by", gap);
        builder.add_box(cell - Vec3(0.3, 0.3, 0.4), cell + Vec3(0.3, 0.3, 0), matter.matte, true);
        builder.look(cell + Vec3(builder.any(-0.2, 0.2), 0, gap), along, roll, fov);
        light_sees = false;
        height = gap;
        return 1;
    }
    builder.look(cell, along, roll, fov);
    if (!matter.specular || !builder.chance(0.2)) return 1;
    const double ior = any_index(builder); // off the middle by less than 1 / ior: no total reflection
    builder.say("eye in glass of index", ior);
    builder.add_sphere(cell + 0.1 * builder.any_direction(), 0.3, add_glass(builder, ior));
    light_sees = false;
    return ior * ior;
}

} // namespace

OddScene odd_furnace(std::uint32_t seed, bool sky)
{
    OddBuilder builder(seed);
    OddScene odd;
    const Rgb radiance = builder.any_colour(0.5, 2);
    Matter matter = add_matter(builder, true, builder.chance(0.6));
    if (sky)
        builder.set_sky(radiance);
    else if (add_walls_of_light(builder, radiance))
        odd.light_sees = false;

    const std::vector<Vec3> cells = any_cells(builder);
    std::size_t cell = 0;
    const Vec3 eye = cells[cell++];
    double height = 1;
    const double there = add_eye(builder, eye, cells[1], matter, odd.light_sees, height);
    for (int things = 1 + builder.pick(5); things > 0; --things)
        if (add_thing(builder, cells[cell++], 0.45, matter)) odd.light_sees = false;
    if (sky && builder.chance(0.3)) {
        // Floats place the eye with an error of 2^-24 of the scene, which must be less than its
        // height; otherwise the picture right in front of it is another one (float_notices.h names
        // such an eye).
        const double half = std::min(builder.any_size(2, largest_thing), std::max(2.0, 1e6 * height));
        builder.say("ground", half);
        builder.add_quad(Vec3(-half, -half, -1.5), Vec3(2 * half, 0, 0), Vec3(0, 2 * half, 0),
                         matter.matte);
        odd.light_sees = odd.light_sees && half < 5;
    }
    if (builder.chance(0.3)) {
        add_shut_lamp(builder, cells[cell++], 0.45, matter.matte);
        odd.light_sees = false;
    }
    if (!sky && builder.chance(0.3)) {
        builder.say("lamps among the things");
        const std::uint32_t lamp = builder.add_material(scenes::Emission{radiance}, "lamp");
        builder.add_sphere(cells[cell++], builder.any_size(smallest_thing, 0.4), lamp);
        const Vec3 c = cells[cell++];
        builder.add_box(c - 0.3, c + 0.3, lamp, true);
    }
    if (builder.chance(0.4)) add_zero_areas(builder, 1.5, matter.matte);

    odd.scene = builder.full();
    odd.description = builder.said();
    odd.mean = builder.brightness() * there * (radiance.x + radiance.y + radiance.z) / 3;
    return odd;
}

} // namespace fast_transport_test
