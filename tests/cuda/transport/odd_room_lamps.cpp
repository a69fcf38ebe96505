#include "tests/cuda/transport/odd_room.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace fast_transport_test {

using scenes::Rgb;
using scenes::Vec3;
using To = OddBuilder::To;

/// The material of a lamp of that area in the current group; powers differ by a factor of at most 30.
std::uint32_t OddRoom::lamp_material(double area)
{
    const double power = builder_.any_size(0.3, 10);
    const std::uint32_t lamp =
        builder_.add_material(scenes::Emission{power / area * builder_.any_colour(0.5, 1)}, "lamp");
    lamps_[second_ ? 1 : 0].insert(lamp);
    return lamp;
}

/// Path tracing finds a directly seen lamp only by chance: hardly ever if the lamp is small. In floats
/// the edges of the lamp have an error of a unit roundoff of the coordinates of its corners, up to 2,
/// at each end.
void OddRoom::see_small_lamp(double width)
{
    odd_.path_sees = false;
    odd_.float_tolerance += 16 * 0x1p-24 / width;
}

/// A lamp that hangs in its cell and faces down: one alone, two back to back, or one that covers
/// another.
void OddRoom::add_quad_lamp()
{
    const Vec3 cell = any_cell();
    const bool tiny = !specular_ && builder_.chance(0.3);
    const double width = tiny ? builder_.any_size(smallest_thing, 0.1) : 0.7;
    const Vec3 x(width, 0, 0);
    const Vec3 y(0, width, 0);
    const std::uint32_t lamp = lamp_material(width * width);
    builder_.say("lamp of width", width);
    if (tiny) see_small_lamp(width);
    if (!tiny && builder_.chance(0.4)) {
        const int strips = 2 + builder_.pick(30);
        builder_.say("in strips:", strips);
        builder_.switch_to(To::full);
        for (int i = 0; i < strips; ++i)
            builder_.add_quad(cell + x * (1.0 * i / strips), y, x / (1.0 * strips), lamp);
        builder_.switch_to(To::plain);
    }
    builder_.add_quad(cell, y, x, lamp);
    builder_.switch_to(To::both);
    if (builder_.chance(0.4)) {
        builder_.say("another at its back");
        builder_.add_quad(cell, x, y, lamp_material(width * width));
    }
    if (builder_.chance(0.3)) {
        builder_.say("a third that it covers");
        builder_.add_quad(cell - 0.2 * x, y, x, lamp_material(width * width));
    }
}

/// A lamp in the plane of the ceiling, or near it.
void OddRoom::add_ceiling_lamp()
{
    if (open_) return add_quad_lamp();
    const double gap = builder_.chance(0.5) ? 0 : builder_.any_size(1e-6, 0.1);
    builder_.say("lamp under the ceiling by", gap);
    builder_.add_quad(Vec3(builder_.any(-1.4, 0), builder_.any(-1.4, 0), 1.5 - gap), Vec3(0, 1, 0),
                      Vec3(1, 0, 0), lamp_material(1));
    std::erase_if(cells_, [](const Vec3& c) { return c.z == 1; });
}

void OddRoom::add_body_lamp()
{
    const Vec3 cell = any_cell();
    if (builder_.chance(0.5)) {
        builder_.say("box lamp");
        builder_.add_box(cell - 0.25, cell + 0.25, lamp_material(1.5), true);
        return;
    }
    const bool in_glass = specular_ && builder_.chance(0.5);
    const double r = specular_ ? 0.3 : builder_.any_size(1e-3, 0.4);
    builder_.say(in_glass ? "ball lamp in glass, radius" : "ball lamp, radius", r);
    if (r < 0.1) see_small_lamp(r);
    builder_.add_sphere(cell, r, lamp_material(12 * r * r));
    if (in_glass) builder_.add_sphere(cell, 0.4, add_glass(builder_, builder_.any(1.05, 1.3)));
}

/// Lights that only next event and light walks find; only in scenes without mirrors and glass.
void OddRoom::add_small_light()
{
    const Vec3 cell = any_cell();
    const Rgb intensity = builder_.any_size(0.3, 3) * builder_.any_colour(0.5, 1);
    switch (builder_.pick(3)) {
    case 0:
        builder_.say("point light");
        builder_.add_point_light(cell, intensity);
        points_.push_back(second_);
        break;
    case 1:
        builder_.say("spot light");
        builder_.add_spot_light(cell, Vec3(0.2, 0.1, -1), intensity, builder_.any(-0.5, 0.8),
                                builder_.any(0, 4));
        spots_.push_back(second_);
        break;
    default:
        if (!open_) return add_quad_lamp();
        builder_.say("sun");
        builder_.add_sun(Vec3(0.3, builder_.exact() ? 0 : 0.1, -1), intensity);
        suns_.push_back(second_);
        break;
    }
}

void OddRoom::add_lamp()
{
    switch (builder_.pick(specular_ ? 3 : 5)) {
    case 0:
        return add_quad_lamp();
    case 1:
        return add_ceiling_lamp();
    case 2:
        return add_body_lamp();
    default:
        return add_small_light();
    }
}

} // namespace fast_transport_test
