#pragma once

// Rays and hits. The direction of a ray need not have unit length: `t` is measured in multiples of it,
// so that the segment from p to q is the ray (p, q - p) with t_max = 1.

#include "scenes/scene.h"

#include <cstdint>
#include <limits>
#include <span>

namespace ref {

using scenes::Rgb;
using scenes::Vec3;

/// The points origin + t * direction with 0 < t < t_max. `on`: primitives on which the origin lies, as
/// far as rounding can tell (scenes/contacts.h). The ray does not hit these at its origin: it cannot
/// hit such a triangle at all, and such a sphere only on the far side.
struct Ray {
    Vec3 origin;
    Vec3 direction;
    double t_max = std::numeric_limits<double>::infinity();
    std::span<const std::uint32_t> on = {};
};

/// The point where a ray hits a primitive (numbered as by scenes::primitive_count).
struct Hit {
    double t;
    std::uint32_t primitive;
    Vec3 barycentric; // weights of the three vertices of a triangle; unused for a sphere
};

/// A point on a surface, in world space.
struct SurfacePoint {
    Vec3 position;
    Vec3 error;  // per coordinate, the largest distance of the true surface from `position`
    Vec3 normal; // unit geometric normal: by winding for a triangle, outward for a sphere
    std::uint32_t primitive;
    std::uint32_t material;
};

} // namespace ref
