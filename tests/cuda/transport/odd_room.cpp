// A room with any lamps. Light is additive: the picture is the sum of those of two groups of lamps,
// each alone. The pictures of the groups are rendered without the additions that change nothing:
// coincident copies, triangles without area, strong lamps that light nothing in the room, lamps in
// pieces, huge objects outside.

#include "tests/cuda/transport/odd_room.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace fast_transport_test {

using scenes::Rgb;
using scenes::Vec3;
using To = OddBuilder::To;

OddRoom::OddRoom(OddBuilder& builder, OddScene& odd) : builder_(builder), odd_(odd)
{
    specular_ = builder.chance(0.3);
    matter_ = add_matter(builder, false, specular_);
    open_ = builder.chance(0.25);
    if (open_) builder.say("no ceiling");
    cells_ = any_cells(builder);
    odd.max_edges = specular_ ? 6 : 4;
}

Vec3 OddRoom::any_cell()
{
    const Vec3 cell = cells_.back();
    cells_.pop_back();
    return cell;
}

void OddRoom::add_walls()
{
    builder_.add_box(Vec3(-1.5), Vec3(1.5), matter_.matte, false, open_ ? 5 : -1);
}

void OddRoom::add_eye()
{
    const Vec3 cell = any_cell();
    const double fov = builder_.any(0.7, 1.6);
    const double roll = builder_.exact() ? 0 : builder_.any(0, 6);
    if (builder_.chance(0.25)) { // close to the floor or on it, looking along it
        const double gap = builder_.chance(0.3) ? 0 : builder_.any_size(1e-6, 1e-2);
        builder_.say("eye above the floor by", gap);
        const Vec3 from(-1.2, builder_.any(-1, 1), -1.5 + gap);
        std::erase_if(cells_, [](const Vec3& c) { return c.x == -1 && c.z == -1; });
        // An eye on the floor also sees the space below it, where there may be a strong lamp. So it
        // looks upwards only, with the corners of the picture 0.41 from its middle.
        if (gap == 0)
            builder_.look(from, Vec3(1, 0, 0.5), roll, 0.6);
        else
            builder_.look(from, Vec3(1, 0, builder_.chance(0.5) ? 0 : 0.3), roll, fov);
        odd_.light_sees = false;
        return;
    }
    const Vec3 along = builder_.chance(0.4) ? (cell.x > 0 ? Vec3(-1, 0, 0) : Vec3(1, 0, 0))
                                            : glm::normalize(Vec3(0.1, 0.2, -0.3) - cell);
    builder_.look(cell, along, roll, fov);
}

/// Adds objects that change nothing.
void OddRoom::add_additions()
{
    builder_.switch_to(To::full);
    if (builder_.chance(0.4)) add_zero_areas(builder_, 1.4, matter_.other);
    if (builder_.chance(0.4)) {
        const int copies = 1 + builder_.pick(20);
        builder_.say("walls over walls:", copies);
        const std::uint32_t glass = add_glass(builder_, 1.5);
        for (int i = 0; i < copies; ++i)
            builder_.add_box(Vec3(-1.5), Vec3(1.5),
                             std::array{matter_.other, matter_.mirror, glass}[i % 3], false,
                             open_ ? 5 : -1);
    }
    if (builder_.chance(0.4)) {
        const double power = builder_.any_size(1, strongest_lamp);
        builder_.say("lamp outside, power", power);
        odd_.light_sees = false;
        const std::uint32_t lamp =
            builder_.add_material(scenes::Emission{Rgb(power / 10)}, "lamp outside");
        const double gap = builder_.chance(0.5) ? 0 : builder_.any_size(1e-5, 1);
        builder_.say("below the floor by", gap);
        // Faces away from the floor, or, from slightly below, towards it.
        const Vec3 p(-1, -1, -1.5 - gap);
        if (gap == 0 || builder_.chance(0.5))
            builder_.add_quad(p, Vec3(0, 2, 0), Vec3(2, 0, 0), lamp);
        else
            builder_.add_quad(p, Vec3(2, 0, 0), Vec3(0, 2, 0), lamp);
    }
    if (!open_ && builder_.chance(0.2)) {
        const double half = builder_.any_size(2, largest_thing);
        builder_.say("huge box outside", half);
        builder_.add_box(Vec3(-half), Vec3(half), matter_.other, false);
    }
    builder_.switch_to(To::both);
}

void OddRoom::add_everything()
{
    add_walls();
    add_eye();
    const int lamps = 1 + builder_.pick(3);
    for (int i = 0; i < lamps; ++i) {
        second_ = i % 2 == 1;
        add_lamp();
    }
    if (open_ && (builder_.chance(0.5) || lamps == 1)) {
        builder_.say("sky");
        builder_.set_sky(builder_.any_colour(0.1, 0.5));
        sky_in_second_ = true;
    }
    if (specular_) odd_.light_sees = false;
    for (int things = builder_.pick(4); things > 0 && cells_.size() > 1; --things) {
        Vec3 cell = any_cell();
        const bool stands =
            cell.z == -1 && builder_.chance(0.5); // on the floor, which its lowest point touches
        if (stands) builder_.say("standing");
        cell.z -= stands ? 0.275 : 0;
        add_thing(builder_, cell, 0.45, matter_);
    }
    if (builder_.chance(0.3) && !cells_.empty()) {
        add_shut_lamp(builder_, any_cell(), 0.45, matter_.other);
        odd_.light_sees = false;
    }
    add_additions();
}

/// The plain scene in which only the lamps of one group are lit; those of the other are there, but
/// dark.
scenes::Scene OddRoom::part(bool second) const
{
    scenes::Scene scene = builder_.plain();
    for (const std::uint32_t lamp : lamps_[second ? 0 : 1])
        scene.materials[lamp] = scenes::Emission{Rgb(0.0)};
    const auto keep = [second](auto& lights, const std::vector<bool>& groups) {
        for (std::size_t i = lights.size(); i-- > 0;)
            if (groups[i] != second) lights.erase(lights.begin() + static_cast<std::ptrdiff_t>(i));
    };
    keep(scene.point_lights, points_);
    keep(scene.spot_lights, spots_);
    keep(scene.directional_lights, suns_);
    if (sky_in_second_ != second) scene.environment.reset();
    return scene;
}

OddScene odd_room(std::uint32_t seed)
{
    OddBuilder builder(seed);
    OddScene odd;
    OddRoom room(builder, odd);
    room.add_everything();
    odd.scene = builder.full();
    odd.description = builder.said();
    odd.parts = {room.part(false), room.part(true)};
    return odd;
}

} // namespace fast_transport_test