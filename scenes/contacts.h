#pragma once

// The contacts of a scene: surfaces that coincide, and points (lights, the eye) that lie on surfaces.
//
// Every coordinate of a file is rounded. Surfaces that are closer than this rounding cannot be told
// apart, and for a point that is meant to be on a surface, its side of the surface cannot be told. The
// picture must not depend on the rounding. So contacts are found before rendering and decided by rule:
//
//   Coincident surfaces. A ray that meets one of them meets them all at the same distance. It sees the
//   first in this order (`meeting_rank`): an emitter from its emitting side; an opaque surface; glass;
//   an emitter from its back. Of several of the same kind it sees the one with the lowest number. This
//   is the limit of a lamp at a vanishing distance from its wall, and of glass sunk into the floor by a
//   vanishing depth.
//
//   A point on a surface: the eye, a point light or a spot light. Light passes the surface there, on
//   both sides. On each side the picture is the limit of a point that approaches from that side.

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

/// The distance up to which a point is on a surface, relative to the larger of a coordinate and an
/// extent.
inline constexpr double double_rounding =
    32 * 0x1p-53; // a dozen products and sums of a node's transforms

/// The surfaces whose distance from `point` is at most `near`, and those on which the point lies (at a
/// distance of at most `on` times the largest coordinate of both). In order of their numbers; surfaces
/// without area are left out.
std::vector<NearSurface> surfaces_near(const Scene& scene, const Vec3& point, double near = 0,
                                       double on = double_rounding);

/// The numbers of the surfaces on which `point` lies.
std::vector<std::uint32_t> surfaces_at(const Scene& scene, const Vec3& point);

/// For every primitive, the primitives that coincide with it.
class Coincidences {
public:
    Coincidences() = default;
    /// From all ordered pairs (a, b) of primitives below `primitives`.
    Coincidences(std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs, std::uint32_t primitives);

    /// Whether no primitives coincide.
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

/// Two triangles coincide if they overlap in an area and their planes differ there by no more than `on`
/// times the largest coordinate of both, or by no more than `at_least` if that is larger. Two spheres
/// coincide if their centres and radii differ by no more than this. Triangles that only share an edge or
/// cross each other do not coincide. Where more than 4096 boxes overlap in one place, the pairs among
/// them are not searched, and `complete`, if given, is set to false.
Coincidences coincidences(const Scene& scene, double on = double_rounding, bool* complete = nullptr,
                          double at_least = 0);

/// The rank of a surface among coincident ones (see above): a ray sees the surface of the lowest rank,
/// and among equal ranks that of the lowest number. `from_front`: the ray comes from the side of the
/// surface's normal.
int meeting_rank(const Material& material, bool from_front);

/// A line for each kind of contact in the scene, for people: the surfaces that touch, and the rule that
/// applies. Two opaque surfaces that face each other, as where a body stands on the ground, are left
/// out.
std::vector<std::string> contact_notices(const Scene& scene);

} // namespace scenes
