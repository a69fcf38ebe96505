// An open plane under any lights, seen after one reflection: radiance = albedo / pi * irradiance, with
// the irradiance of each light in closed form (lit_plane.h). Objects below the plane, in it (listed
// later), or without area change nothing.

#include "scenes/bounds.h"
#include "tests/cuda/transport/lit_plane.h"
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

using std::numbers::pi;

/// A view of the plane within 0.5 of the origin, from a distance of at most 1.2.
PlaneEye any_eye(OddBuilder& builder)
{
    const double distance = builder.any(0.4, 1.2);
    const int how = builder.pick(3);
    const double elevation = how == 0   ? pi / 2
                             : how == 1 ? builder.any_size(0.01, 0.1)
                                        : builder.any(0.3, 1.5);
    if (how == 0) builder.say("eye straight above");
    if (how == 1) builder.say("eye at a grazing angle", elevation);
    const bool exact = builder.exact();
    const double azimuth = exact ? 0 : builder.any(0, 2 * pi);
    const Vec3 back = how == 0 ? Vec3(0, 0, 1)
                               : Vec3(std::cos(azimuth) * std::cos(elevation),
                                      std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
    const Vec3 at = exact ? Vec3(0) : Vec3{builder.any(-0.1, 0.1), builder.any(-0.1, 0.1), 0};
    const double span = std::tan(std::min(0.2, 0.2 * elevation) / 1.5);
    builder.look(at + distance * back, -back, exact ? 0 : builder.any(0, 6), 2 * std::atan(span));
    const scenes::Camera& camera = *builder.full().camera;
    const auto in_frame = [&](const Vec3& w) {
        return Vec3(glm::dot(w, builder.turn(Vec3(1, 0, 0))), glm::dot(w, builder.turn(Vec3(0, 1, 0))),
                    glm::dot(w, builder.turn(Vec3(0, 0, 1))));
    };
    return {at + distance * back, in_frame(camera.right), in_frame(camera.up), -back, span};
}

/// The plane: two triangles, or many with a common corner in the origin, which may be in the middle of
/// the picture. Returns half the width of the plane.
double add_plane(OddBuilder& builder, std::uint32_t material, std::uint32_t hidden)
{
    const double half = builder.chance(0.2) ? builder.any_size(3, largest_thing) : 3;
    if (half > 3) builder.say("plane of half width", half);
    const Vec3 corner(-half, -half, 0);
    const Vec3 x(2 * half, 0, 0);
    const Vec3 y(0, 2 * half, 0);
    if (builder.chance(0.5)) {
        const int count = 2 + builder.pick(30); // per side
        builder.say("plane of triangles that meet in the origin:", 4 * count);
        const std::array<Vec3, 5> corners = {corner, corner + x, corner + x + y, corner + y, corner};
        for (std::size_t side = 0; side < 4; ++side)
            for (int i = 0; i < count; ++i) {
                const Vec3 step = (corners[side + 1] - corners[side]) / static_cast<double>(count);
                builder.add_triangle(Vec3(0), corners[side] + static_cast<double>(i) * step,
                                     corners[side] + (i + 1.0) * step, material);
            }
    } else {
        builder.add_quad(corner, x, y, material);
    }
    if (builder.chance(0.5)) {
        const int copies = 1 + builder.pick(30);
        builder.say("copies of the plane:", copies);
        for (int i = 0; i < copies; ++i)
            i % 2 == 0 ? builder.add_quad(corner, x, y, hidden)
                       : builder.add_quad(0.7 * corner, 0.7 * y, 0.7 * x, hidden);
    }
    return half;
}

/// Adds lamps and objects that the plane hides. Returns whether there are strong lamps among them.
bool add_hidden(OddBuilder& builder, double half)
{
    const bool far = builder.chance(0.2);
    const double depth = far ? builder.any_size(3, largest_thing) : 1;
    if (far) builder.say("hidden things farther away", depth);
    const double power = builder.any_size(1, strongest_lamp);
    const std::uint32_t lamp =
        builder.add_material(scenes::Emission{Rgb(power / (3 * depth * depth))}, "hidden lamp");
    switch (builder.pick(5)) {
    case 0:
        return false;
    case 1:
        builder.say("hidden ball lamp of power", power);
        builder.add_sphere(Vec3(0, 0, -2 * depth), 0.3 * depth, lamp);
        return true;
    case 2: {
        const double below = builder.chance(0.5) ? 0 : builder.any_size(1e-5, 0.1); // faces down
        builder.say("lamp under the plane by", below);
        builder.say("of power", power);
        builder.add_quad(Vec3(-0.3, -0.3, -below), Vec3(0, 0.6, 0), Vec3(0.6, 0, 0), lamp);
        return true;
    }
    case 3:
        builder.say("hidden point light of power", power);
        builder.add_point_light(Vec3(0.1, 0.1, -0.5), Rgb(power / 10));
        return true;
    default:
        builder.say("lamp that shines at the back of the plane, power", power);
        builder.add_quad(Vec3(-0.5 * half, 0, -0.2 * depth), Vec3(half, 0, 0), Vec3(0, 0.5 * half, 0),
                         lamp);
        return true;
    }
}

} // namespace

OddScene odd_plane(std::uint32_t seed)
{
    OddBuilder builder(seed);
    OddScene odd;
    odd.max_edges = 2;
    const Matter matter = add_matter(builder, false, true);
    const PlaneEye eye = any_eye(builder);
    const double half =
        add_plane(builder, matter.matte, builder.chance(0.5) ? matter.other : matter.mirror);

    LitPlane lit(builder, eye);
    if (builder.chance(0.4)) lit.add_lamp();
    if (builder.chance(0.4)) lit.add_sky();
    if (builder.chance(0.4)) lit.add_point();
    if (builder.chance(0.3)) lit.add_spot();
    if (builder.chance(0.2)) lit.add_narrow_spot();
    if (builder.chance(0.4)) lit.add_sun();
    if (lit.irradiance() == Rgb(0.0)) lit.add_point();
    const bool strong = add_hidden(builder, half);
    if (builder.chance(0.5)) add_zero_areas(builder, 2, matter.matte);

    odd.path_sees = !lit.has_narrow_spot();
    odd.light_sees = !strong && half <= 3 && !lit.far_or_low() && eye.from.z > 0.3;
    // Coordinates have an error of a few unit roundoffs of the size of the scene, hidden objects
    // included. 16 of them bound the sum for a point of the plane, a light and the edges of a lamp.
    // The error of a narrow spot, relative to its width, is the error of its light's position and of
    // the plane.
    const auto box = scenes::bounds(builder.full()).value();
    const double largest = std::max(3.0, glm::length(box.max - box.min) / builder.size());
    odd.float_tolerance += 16 * 0x1p-24 * lit.condition() * largest + lit.spot_tolerance() * largest;
    const Rgb albedo = std::get<scenes::Lambertian>(builder.full().materials[matter.matte]).albedo;
    const Rgb radiance = albedo / pi * lit.irradiance();
    odd.scene = builder.full();
    odd.description = builder.said();
    odd.mean = builder.brightness() * (radiance.x + radiance.y + radiance.z) / 3;
    return odd;
}

} // namespace fast_transport_test