#pragma once

// Whether two points see each other. Both ends are moved off their surfaces by their own error bounds,
// so the segment between them is tested whole, with no epsilon at either end.

#include "ref/transport/emitter.h"
#include "ref/trees/geometry.h"

namespace ref {

/// Whether nothing stands between two points on surfaces.
inline bool visible(const Geometry& geometry, const SurfacePoint& a, const SurfacePoint& b)
{
    const Vec3 d = b.position - a.position;
    const Vec3 from = leave_surface(a, d);
    return !occluded(geometry, {from, leave_surface(b, -d) - from, 1.0});
}

/// Whether nothing stands between a point on a surface and one in free space.
inline bool visible(const Geometry& geometry, const SurfacePoint& a, const Vec3& b)
{
    const Vec3 from = leave_surface(a, b - a.position);
    return !occluded(geometry, {from, b - from, 1.0});
}

/// Whether `light`, drawn for the surface at `point`, reaches it.
inline bool visible(const Geometry& geometry, const SurfacePoint& point, const IncidentLight& light)
{
    if (light.infinite) return !occluded(geometry, {leave_surface(point, light.wi), light.wi});
    if (light.delta) return visible(geometry, point, light.end.position);
    return visible(geometry, point, light.end);
}

} // namespace ref
