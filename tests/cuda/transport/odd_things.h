#pragma once

// Objects for odd scenes: bodies that touch, coincide or are nested, slivers, and very small ones.
// They lose no light except by the absorption of their materials.

#include "tests/cuda/transport/odd_builder.h"

namespace fast_transport_test {

/// The smallest size of an object, in units in which the room is 3 wide. The tolerance for single
/// precision grows with its inverse: for a lamp of 1e-4 it is 1%. A larger minimum would test less.
inline constexpr double smallest_thing = 1e-4;

/// The largest size: a thousand rooms.
inline constexpr double largest_thing = 1e3;

/// The largest ratio of the power of a hidden lamp to that of a visible one.
inline constexpr double strongest_lamp = 1e12;

/// The materials of objects: two Lambertian ones, and, if `specular`, a mirror and glass that absorbs
/// nothing.
struct Matter {
    std::uint32_t matte, other, mirror, black;
    bool specular;
    bool cusps = true; // whether bodies may touch in a point: walks between white ones are long
};

Matter add_matter(OddBuilder& builder, bool white, bool specular);

/// Adds an object inside the ball around `center`. Returns whether any part of it is specular.
bool add_thing(OddBuilder& builder, const OddBuilder::Vec3& center, double radius, const Matter& matter);

/// Adds a closed box with a lamp of enormous power that lights nothing else. The lamp is only in the
/// full scene.
void add_shut_lamp(OddBuilder& builder, const OddBuilder::Vec3& center, double radius,
                   std::uint32_t material);

/// Adds triangles without area, anywhere within `reach` of the origin: points, folded lines, and lines
/// along an axis.
void add_zero_areas(OddBuilder& builder, double reach, std::uint32_t material);

/// The centres of 27 cells around the origin, at distances of 1, in random order.
std::vector<OddBuilder::Vec3> any_cells(OddBuilder& builder);

/// An index of glass: mostly between 1 and 2, sometimes 1 or that of a bubble.
double any_index(OddBuilder& builder);

/// Glass that absorbs nothing.
std::uint32_t add_glass(OddBuilder& builder, double ior);

} // namespace fast_transport_test
