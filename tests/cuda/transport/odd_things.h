#pragma once

// Things to put into odd scenes: bodies that touch, coincide or are nested, slivers, and much too small
// ones. No light gets lost in them but for what their materials absorb.

#include "tests/cuda/transport/odd_builder.h"

namespace cuda_test {

/// How small a thing may be, in units of the room, which is 3 wide. The tolerance for single precision
/// grows with its inverse: for a lamp of 1e-4 it is 1%. A smaller range would test less.
inline constexpr double smallest_thing = 1e-4;

/// How large: a thousand rooms.
inline constexpr double largest_thing = 1e3;

/// How much more power a lamp that is not seen may have than those that are.
inline constexpr double strongest_lamp = 1e12;

/// Materials of things: two that scatter, and, if `specular`, a mirror and glass that absorbs nothing.
struct Matter {
    std::uint32_t matte, other, mirror, black;
    bool specular;
    bool cusps = true; // whether bodies may touch in a point: walks between white ones are very long
};

Matter add_matter(OddBuilder& builder, bool white, bool specular);

/// Adds a thing inside the ball around `center`. Returns whether any of it is specular.
bool add_thing(OddBuilder& builder, const OddBuilder::Vec3& center, double radius, const Matter& matter);

/// A closed box with a lamp of enormous power in it, that lights nothing else. The lamp is in the full
/// scene only.
void add_shut_lamp(OddBuilder& builder, const OddBuilder::Vec3& center, double radius,
                   std::uint32_t material);

/// Triangles without area, anywhere within `reach` of the origin: points, lines that are folded, and
/// lines along an axis.
void add_zero_areas(OddBuilder& builder, double reach, std::uint32_t material);

/// Centres of 27 cells around the origin, 1 apart, in random order.
std::vector<OddBuilder::Vec3> any_cells(OddBuilder& builder);

/// An index of glass: mostly between 1 and 2, now and then 1, or that of a bubble.
double any_index(OddBuilder& builder);

/// Glass that absorbs nothing.
std::uint32_t add_glass(OddBuilder& builder, double ior);

} // namespace cuda_test
