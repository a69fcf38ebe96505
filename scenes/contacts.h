#pragma once

// Where a scene's parts touch: surfaces that coincide, and places of lights and the eye on surfaces.
//
// Rounding moves every coordinate of a file a little. Surfaces closer than that cannot be told apart,
// and neither can the side of a surface on which a point lies that is meant to be on it. What a renderer
// makes of it must not depend on that rounding. So the cases are found beforehand, and decided by rule:
//
//   Coincident surfaces. A ray that meets one of them meets them all at the same distance. It sees the
//   first in this order (`meeting_rank`): an emitter from its shining side; a surface that is opaque;
//   glass; an emitter from its dark side. Of several of one kind it sees the lowest number. This is the
//   limit of a lamp that stands a little away from its wall, and of glass sunk a little into the floor.
//
//   A point on a surface: the eye, a point light or a spot light. Light passes that surface there, on
//   both sides; on the other side too the picture is the limit of a point that approaches from there.

#include "scenes/scene.h"

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace scenes {

/// A surface near a point.
struct NearSurface {
    std::uint32_t primitive;
    int side;    // 0: the point is on it; 1, -1: it is near, on the side of the normal or on the other
    Vec3 normal; // unit geometric normal of the surface where it is nearest
};

/// How near is on, in units of the larger of a coordinate and an extent.
inline constexpr double double_rounding =
    32 * 0x1p-53; // a dozen products and sums of a node's transforms

/// The surfaces whose distance from `point` is at most `near`, and those that it is on: no farther than
/// `on` times the largest coordinate of both. In order of their numbers; surfaces without area do not
/// count.
std::vector<NearSurface> surfaces_near(const Scene& scene, const Vec3& point, double near = 0,
                                       double on = double_rounding);

/// The numbers of those that `point` is on.
std::vector<std::uint32_t> surfaces_at(const Scene& scene, const Vec3& point);

/// For every primitive those that coincide with it.
class Coincidences {
public:
    Coincidences() = default;
    /// From all ordered pairs (a, b) of primitives below `primitives`.
    Coincidences(std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs, std::uint32_t primitives);

    /// Whether there are none at all.
    [[nodiscard]] bool empty() const { return others_.empty(); }
    /// In order of their numbers; without `primitive` itself.
    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t primitive) const
    {
        if (others_.empty()) return {};
        return std::span(others_).subspan(begin_[primitive], begin_[primitive + 1] - begin_[primitive]);
    }

private:
    std::vector<std::size_t> begin_; // into others_, by primitive
    std::vector<std::uint32_t> others_;
};

/// Coincident are two triangles that overlap in an area while their planes differ there by no more than
/// `on` times the largest coordinate of both, or by `at_least` if that is more; and two spheres whose
/// centres and radii differ by no more. Edges that meet do not count, nor do surfaces that cross. Where
/// more than 4096 boxes overlap in one place the pairs among them are not looked for, and `complete`, if
/// given, is set to false.
Coincidences coincidences(const Scene& scene, double on = double_rounding, bool* complete = nullptr,
                          double at_least = 0);

/// Which of several coincident surfaces a ray sees, see above: that of the lowest rank, and of these the
/// lowest number. `from_front`: the ray comes from the side of the surface's normal.
int meeting_rank(const Material& material, bool from_front);

/// A line for each kind of contact in the scene, for people: what touches what, and what is made of it.
/// Two opaque surfaces that face each other, as where a body stands on the ground, are not worth one.
std::vector<std::string> contact_notices(const Scene& scene);

} // namespace scenes
