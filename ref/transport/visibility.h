#pragma once

// Whether two points see each other. Ends on surfaces are moved off them by their own error bounds, so
// the whole segment between them is tested, with no epsilon at either end. An end in free space that
// happens to lie on a surface is not hidden by that surface (scenes/contacts.h).

#include "ref/transport/emitter.h"
#include "ref/trees/geometry.h"

#include <algorithm>
#include <span>

namespace ref {

/// What has to be free of surfaces so that two points see each other: `ray`, if `test` says so.
struct LineOfSight {
    enum class Test {
        ray,     // free if `ray` hits nothing
        in_plane // not free: a triangle contains both points
    };
    Test test;
    Ray ray;
};

/// Between two points on surfaces.
inline LineOfSight line_of_sight(const SurfacePoint& a, const SurfacePoint& b)
{
    const Vec3 d = b.position - a.position;
    const Vec3 from = leave_surface(a, d);
    const Vec3 to = end_at_surface(b, -d);
    return {LineOfSight::Test::ray, {from, to - from, 1.0}};
}

/// Between a point on a surface and a point in free space. The latter lies on the surfaces `b_on`, which
/// must outlive the result. A triangle that contains both points hides b, since the segment lies in it.
inline LineOfSight line_of_sight(const Geometry& geometry, const SurfacePoint& a, const Vec3& b,
                                 std::span<const std::uint32_t> b_on = {})
{
    const Vec3 d = b - a.position;
    const Vec3 from = leave_surface(a, d);
    if (b_on.empty()) return {LineOfSight::Test::ray, {from, b - from, 1.0}};
    const bool in_plane = a.primitive < geometry.scene().triangles.size() &&
                          std::ranges::find(b_on, a.primitive) != b_on.end();
    if (in_plane) return {LineOfSight::Test::in_plane, {}};
    return {LineOfSight::Test::ray, {b, end_at_surface(a, d) - b, 1.0, b_on}};
}

/// Between `light`, sampled for the surface at `point`, and that surface.
inline LineOfSight line_of_sight(const Geometry& geometry, const SurfacePoint& point,
                                 const IncidentLight& light)
{
    if (light.infinite) return {LineOfSight::Test::ray, {leave_surface(point, light.wi), light.wi}};
    if (light.delta) return line_of_sight(geometry, point, light.end.position, light.emitter->on);
    return line_of_sight(point, light.end);
}

inline bool is_free(const Geometry& geometry, const LineOfSight& line)
{
    return line.test == LineOfSight::Test::ray && !occluded(geometry, line.ray);
}

/// Whether no surface lies between two points on surfaces.
inline bool visible(const Geometry& geometry, const SurfacePoint& a, const SurfacePoint& b)
{
    return is_free(geometry, line_of_sight(a, b));
}

/// Whether no surface lies between a point on a surface and a point in free space, which lies on the
/// surfaces `b_on`.
inline bool visible(const Geometry& geometry, const SurfacePoint& a, const Vec3& b,
                    std::span<const std::uint32_t> b_on = {})
{
    return is_free(geometry, line_of_sight(geometry, a, b, b_on));
}

/// Whether `light`, sampled for the surface at `point`, has a surface of its own that another one covers
/// there: then the walk would meet the other one.
inline bool is_covered(const Geometry& geometry, const IncidentLight& light)
{
    return !light.infinite && !light.delta && !sees_first(geometry, light.end, -light.wi);
}

/// Whether no surface lies between `light`, sampled for the surface at `point`, and that surface.
inline bool visible(const Geometry& geometry, const SurfacePoint& point, const IncidentLight& light)
{
    return is_free(geometry, line_of_sight(geometry, point, light)) && !is_covered(geometry, light);
}

} // namespace ref
