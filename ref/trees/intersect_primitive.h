#pragma once

// A ray against a primitive of a scene, whichever kind it is.

#include "ref/trees/intersect.h"

#include <algorithm>
#include <optional>

namespace ref {

/// Where `ray` (`sheared` is the same ray) hits primitive number `primitive`, which may be one that its
/// origin lies on.
inline std::optional<Hit> intersect_primitive(const scenes::Scene& scene, const Ray& ray,
                                              const ShearedRay& sheared, std::uint32_t primitive)
{
    const bool leaves = !ray.on.empty() && std::ranges::find(ray.on, primitive) != ray.on.end();
    if (primitive < scene.triangles.size()) {
        if (leaves) return std::nullopt; // a plane is met once
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

/// Closer, or as close and of lower number: so the closest hit does not depend on the order of tests.
inline bool comes_before(const Hit& a, const Hit& b)
{
    return a.t < b.t || (a.t == b.t && a.primitive < b.primitive);
}

} // namespace ref
