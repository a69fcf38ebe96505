#include "tests/cuda/transport/odd_things.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fast_transport_test {

using scenes::Rgb;
using scenes::Vec3;

namespace {

using Add = bool (*)(OddBuilder&, const Vec3&, double, const Matter&);

std::uint32_t any_of_matter(OddBuilder& builder, const Matter& matter)
{
    if (matter.specular && builder.chance(0.2)) return matter.mirror;
    return builder.chance(0.5) ? matter.matte : matter.other;
}

bool add_ball(OddBuilder& builder, const Vec3& c, double r, const Matter& matter)
{
    const std::uint32_t material = any_of_matter(builder, matter);
    builder.say("ball");
    builder.add_sphere(c, r, material);
    return material == matter.mirror;
}

bool add_block(OddBuilder& builder, const Vec3& c, double r, const Matter& matter)
{
    const std::uint32_t material = any_of_matter(builder, matter);
    builder.say("block");
    builder.add_box(c - 0.5 * r, c + 0.5 * r, material, true);
    return material == matter.mirror;
}

/// One block on another: two faces coincide, one is a part of the other.
bool add_stack(OddBuilder& builder, const Vec3& c, double r, const Matter& matter)
{
    builder.say("block on block");
    const std::uint32_t material = any_of_matter(builder, matter);
    builder.add_box(c - 0.5 * r, c + r * Vec3(0.5, 0.5, 0), material, true);
    const double edge = builder.chance(0.3) ? 0.5 : 0.3; // 0.5: the sides lie in one plane too
    builder.add_box(c - r * Vec3(0.3, edge, 0), c + r * Vec3(0.2, edge, 0.5), matter.other, true);
    return material == matter.mirror;
}

bool add_ball_on_block(OddBuilder& builder, const Vec3& c, double r, const Matter& matter)
{
    if (!matter.cusps) return add_stack(builder, c, r, matter);
    builder.say("ball that touches a block");
    builder.add_box(c - 0.5 * r, c + r * Vec3(0.5, 0.5, 0), matter.matte, true);
    builder.add_sphere(c + Vec3(0, 0, 0.25 * r), 0.25 * r, matter.other);
    return false;
}

bool add_block_in_block(OddBuilder& builder, const Vec3& c, double r, const Matter& matter)
{
    builder.say("block in block");
    const double wall = builder.chance(0.5) ? 0.4 : 0.4999;
    builder.add_box(c - 0.5 * r, c + 0.5 * r, matter.matte, true);
    builder.add_box(c - wall * r, c + wall * r, matter.other, builder.chance(0.5));
    return false;
}

bool add_box_without_lid(OddBuilder& builder, const Vec3& c, double r, const Matter& matter)
{
    builder.say("box without lid");
    builder.add_box(c - 0.5 * r, c + 0.5 * r,
                    any_of_matter(builder, {matter.matte, matter.other, 0, 0, false}), true,
                    builder.pick(6));
    return false;
}

/// Many copies, with two materials in turn: the first one is visible.
bool add_copies(OddBuilder& builder, const Vec3& c, double r, const Matter& matter)
{
    const int copies = 2 + builder.pick(40);
    builder.say("copies of a triangle:", copies);
    const Vec3 a = c + r * builder.any_direction();
    const Vec3 b = c + r * builder.any_direction();
    const Vec3 d = c + r * builder.any_direction();
    for (int i = 0; i < copies; ++i) {
        const std::uint32_t material = i % 2 == 0 ? matter.matte : matter.other;
        i % 3 == 0 ? builder.add_triangle(a, b, d, material) : builder.add_triangle(b, a, d, material);
    }
    return false;
}

/// A disc of triangles that share a corner in the middle: 3 to 60 of them, or slivers with an angle of
/// 1e-6.
bool add_fan(OddBuilder& builder, const Vec3& c, double r, const Matter& matter)
{
    const bool slivers = builder.chance(0.5);
    const int count = 3 + builder.pick(58);
    builder.say(slivers ? "fan of slivers:" : "fan:", count);
    const double step = slivers ? 1e-6 : 2 * std::numbers::pi / count;
    const auto rim = [&](int i) {
        const double angle = step * i;
        return c + r * Vec3(std::cos(angle), std::sin(angle), 0);
    };
    for (int i = 0; i < count; ++i)
        builder.add_triangle(c, rim(i), rim(i + 1), i % 2 == 0 ? matter.matte : matter.other);
    return false;
}

bool add_glass_body(OddBuilder& builder, const Vec3& c, double r, const Matter& matter)
{
    if (!matter.specular) return add_ball(builder, c, r, matter);
    const std::uint32_t glass = add_glass(builder, any_index(builder));
    const bool is_ball = builder.chance(0.5);
    builder.say(is_ball ? "glass ball" : "glass block");
    is_ball ? builder.add_sphere(c, r, glass) : builder.add_box(c - 0.5 * r, c + 0.5 * r, glass, true);
    return true;
}

/// The object in the middle is so small that no light from it is totally reflected; otherwise paths
/// would be very long.
bool add_nested_glass(OddBuilder& builder, const Vec3& c, double r, const Matter& matter)
{
    if (!matter.specular) return add_stack(builder, c, r, matter);
    builder.say("nested in a glass ball");
    const double ior = any_index(builder);
    builder.add_sphere(c, r, add_glass(builder, ior));
    const double inner = builder.any_size(0.01, 0.9) * r / std::max(1.0, ior);
    switch (builder.pick(3)) {
    case 0:
        builder.add_sphere(c, inner, add_glass(builder, builder.any(1.05, 1.3)));
        builder.add_sphere(c, 0.5 * inner, matter.matte);
        break;
    case 1:
        builder.add_sphere(c, inner, matter.matte);
        break;
    default:
        builder.add_box(c - 0.5 * inner, c + 0.5 * inner, matter.other, true);
        break;
    }
    return true;
}

} // namespace

Matter add_matter(OddBuilder& builder, bool white, bool specular)
{
    const auto colour = [&] { // in every channel, so that every lamp is visible
        return white ? Rgb(1.0) : glm::max(builder.any_colour(0.2, 0.8), Rgb(0.1));
    };
    Matter matter{};
    matter.matte = builder.add_material(scenes::Lambertian{colour()}, "matte");
    matter.other = builder.add_material(scenes::Lambertian{colour()}, "other");
    matter.mirror = builder.add_material(scenes::Mirror{white ? Rgb(1.0) : Rgb(0.9)}, "mirror");
    matter.black = builder.add_material(scenes::Lambertian{Rgb(0.0)}, "black");
    matter.specular = specular;
    return matter;
}

std::vector<Vec3> any_cells(OddBuilder& builder)
{
    std::vector<Vec3> cells;
    for (int i = 0; i < 27; ++i) cells.emplace_back(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    for (std::size_t i = cells.size() - 1; i > 0; --i)
        std::swap(cells[i], cells[static_cast<std::size_t>(builder.pick(static_cast<int>(i + 1)))]);
    return cells;
}

double any_index(OddBuilder& builder)
{
    if (builder.chance(0.1)) return 1;
    if (builder.chance(0.1)) return builder.any(0.5, 1);
    return builder.any(1.05, 2);
}

std::uint32_t add_glass(OddBuilder& builder, double ior)
{
    return builder.add_material(scenes::Glass{Rgb(1.0), Rgb(1.0), ior}, "glass");
}

bool add_thing(OddBuilder& builder, const Vec3& center, double radius, const Matter& matter)
{
    constexpr std::array<Add, 10> kinds = {
        add_ball,           add_block,           add_stack,  add_ball_on_block,
        add_block_in_block, add_box_without_lid, add_copies, add_fan,
        add_glass_body,     add_nested_glass};
    if (builder.chance(0.2)) {
        radius *= builder.any_size(smallest_thing, 1);
        builder.say("tiny", radius);
    }
    return kinds[static_cast<std::size_t>(builder.pick(kinds.size()))](builder, center, radius, matter);
}

void add_shut_lamp(OddBuilder& builder, const Vec3& center, double radius, std::uint32_t material)
{
    const double power = builder.any_size(1, strongest_lamp);
    builder.say("lamp in a closed box, power", power);
    builder.add_box(center - 0.5 * radius, center + 0.5 * radius, material, true);
    const double r = 0.3 * radius;
    const std::uint32_t lamp =
        builder.add_material(scenes::Emission{Rgb(power / (40 * r * r))}, "shut lamp");
    builder.switch_to(OddBuilder::To::full);
    if (builder.chance(0.5))
        builder.add_sphere(center, r, lamp);
    else
        builder.add_quad(center - r * Vec3(1, 1, 0), Vec3(2 * r, 0, 0), Vec3(0, 2 * r, 0), lamp);
    builder.switch_to(OddBuilder::To::both);
}

void add_zero_areas(OddBuilder& builder, double reach, std::uint32_t material)
{
    const int count = 1 + builder.pick(20);
    builder.say("triangles without area:", count);
    for (int i = 0; i < count; ++i) {
        const Vec3 p = builder.any(0, reach) * builder.any_direction();
        const Vec3 w = builder.exact() ? Vec3(0, 0, reach) : reach * builder.any_direction();
        switch (builder.pick(3)) {
        case 0:
            builder.add_triangle(p, p, p, material);
            break;
        case 1:
            builder.add_triangle(p, p + w, p, material);
            break;
        default: // rounding gives it an area of about 1e-16
            builder.add_triangle(p, p + 0.25 * w, p + w, material);
            break;
        }
    }
}

} // namespace fast_transport_test
