#pragma once

// The intersection of a ray with a primitive of a scene, triangle or sphere.

#include "ref/trees/intersect.h"

#include <algorithm>
#include <optional>

namespace ref {

/// The hit of `ray` on primitive number `primitive`, on which its origin may lie (Ray::on). `sheared`
/// is the same ray.
inline std::optional<Hit> intersect_primitive(const scenes::Scene& scene, const Ray& ray,
                                              const ShearedRay& sheared, std::uint32_t primitive)
{
    const bool leaves = !ray.on.empty() && std::ranges::find(ray.on, primitive) != ray.on.end();
    if (primitive < scene.triangles.size()) {
        if (leaves) return std::nullopt; // a line crosses a plane only once
        const auto hit = intersect_triangle(sheared, scene.triangles[primitive].vertices);
        if (!hit) return std::nullopt;
        return Hit{hit->t, primitive, hit->barycentric};
    }
    const scenes::Sphere& sphere = scene.spheres[primitive - scene.triangles.size()];
    const auto t =
        leaves ? leave_sphere(ray, sphere.center) : intersect_sphere(ray, sphere.center, sphere.radius);
    if (!t) return std::nullopt;
    return Hit{*t, primitive, Vec3(0)};
}

/// Whether `a` is closer, or as close and of lower number: so the closest hit does not depend on the
/// order of tests.
inline bool comes_before(const Hit& a, const Hit& b)
{
    return a.t < b.t || (a.t == b.t && a.primitive < b.primitive);
}

} // namespace ref
