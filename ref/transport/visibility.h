#pragma once

// Whether two points see each other. Ends on surfaces are moved off them by their own error bounds, so
// the whole segment between them is tested, with no epsilon at either end. An end in free space that
// happens to lie on a surface is not hidden by that surface (scenes/contacts.h).

#include "ref/transport/emitter.h"
#include "ref/trees/geometry.h"

#include <algorithm>
#include <span>

namespace ref {

/// Whether the ends of a segment d, moved to `from` and `to` by the fixed distance Geometry::epsilon,
/// have passed each other: then nothing of it is left to be tested.
inline bool is_used_up(const Geometry& geometry, const Vec3& d, const Vec3& from, const Vec3& to)
{
    return geometry.epsilon() != 0.0 && glm::dot(to - from, d) <= 0.0;
}

/// Whether no surface lies between two points on surfaces.
inline bool visible(const Geometry& geometry, const SurfacePoint& a, const SurfacePoint& b)
{
    const Vec3 d = b.position - a.position;
    const Vec3 from = leave_surface(a, d);
    const Vec3 to = end_at_surface(b, -d);
    return is_used_up(geometry, d, from, to) || !occluded(geometry, {from, to - from, 1.0});
}

/// Whether no surface lies between a point on a surface and a point in free space. The latter lies on
/// the surfaces `b_on`. A triangle that contains both points hides b, since the segment lies in it.
inline bool visible(const Geometry& geometry, const SurfacePoint& a, const Vec3& b,
                    std::span<const std::uint32_t> b_on = {})
{
    const Vec3 d = b - a.position;
    const Vec3 from = leave_surface(a, d);
    if (is_used_up(geometry, d, from, b)) return true;
    if (b_on.empty()) return !occluded(geometry, {from, b - from, 1.0});
    const bool in_plane = a.primitive < geometry.scene().triangles.size() &&
                          std::ranges::find(b_on, a.primitive) != b_on.end();
    return !in_plane && !occluded(geometry, {b, end_at_surface(a, d) - b, 1.0, b_on});
}

/// Whether no surface lies between `light`, sampled for the surface at `point`, and that surface.
inline bool visible(const Geometry& geometry, const SurfacePoint& point, const IncidentLight& light)
{
    if (light.infinite) return !occluded(geometry, {leave_surface(point, light.wi), light.wi});
    if (light.delta) return visible(geometry, point, light.end.position, light.emitter->on);
    return visible(geometry, point, light.end) && sees_first(geometry, light.end, -light.wi);
}

} // namespace ref
