#pragma once

// Rooms in which objects touch, so closely that rounding cannot separate them; turned and moved at
// random so that no coordinate is exact.

#include "scenes/scene.h"

#include <cstdint>
#include <string>

namespace fast_transport_test {

enum class Touching {
    point_light_on_lamp, // in the plane of a lamp that hangs in the room
    point_light_on_wall,
    point_light_in_corner, // of three walls
    point_light_on_sphere,
    spot_light_on_wall,
    eye_on_wall,
    eye_in_edge, // of two walls
    lamp_in_wall,
    lamps_back_to_back,
    lamp_under_lamp, // two that shine to the same side: the one of lower number is seen
    glass_on_floor
};

/// A room of kind `kind`, made from `seed`. `gap` (>= 0, in units of half the room's width) moves the
/// touching object away from the other, into the room; 0 for contact. With a gap it is an ordinary
/// scene.
scenes::Scene touching_scene(Touching kind, std::uint32_t seed, double gap);

std::string name_of(Touching kind);

} // namespace fast_transport_test
