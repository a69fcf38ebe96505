#pragma once

// A point on a surface, from a hit or from a sample.

#include "cuda/transport/scene_view.h"

namespace fast {

/// (v1 - v0) x (v2 - v0) scaled to unit length; its square may underflow. Any unit vector if the
/// product has no direction.
HD inline Vec3 unit_normal(const Vec3& e1, const Vec3& e2)
{
    const Vec3 across = glm::cross(e1, e2);
    const float size = max_component(glm::abs(across));
    return size > 0.0f ? glm::normalize(across / size) : Vec3(0.0f, 0.0f, 1.0f);
}

/// The point of triangle number `triangle` with weights b1, b2 of its second and third vertex, moved
/// off the edges by a few roundings (clearance.h, step 8).
template <Needs needs>
HD SurfacePoint triangle_point(const SceneView<needs>& scene, std::uint32_t triangle, float b1, float b2)
{
    const auto& v = scene.triangles[triangle].vertices;
    const Vec3 e1 = v[1] - v[0];
    const Vec3 e2 = v[2] - v[0];
    const Surface& surface = scene.surfaces[triangle];
    move_off_edges(surface.edge_margin, b1, b2);
    SurfacePoint point{};
    point.primitive = triangle;
    point.position = v[0] + (b1 * e1 + b2 * e2);
    point.normal = surface.normal;
    point.clearance = clearance_at(point.position, point.normal, surface.clearance);
    return point;
}

/// The point of sphere number `sphere` (the first is 0 after the triangles) in `direction` (any length)
/// from its centre.
template <Needs needs>
HD SurfacePoint sphere_point(const SceneView<needs>& scene, std::uint32_t primitive,
                             const Vec3& direction)
{
    const Sphere& sphere = scene.spheres[primitive - static_cast<std::uint32_t>(scene.triangles.size())];
    SurfacePoint point{};
    point.primitive = primitive;
    point.normal = glm::normalize(direction);
    point.position = sphere.center + sphere.radius * point.normal;
    point.clearance = clearance_at(point.position, point.normal, scene.surfaces[primitive].clearance);
    return point;
}

/// The surface at `hit`, which must be a hit of `ray`.
template <Needs needs>
HD SurfacePoint surface_point(const SceneView<needs>& scene, const Ray& ray, const Hit& hit)
{
    if constexpr (needs.spheres) {
        const auto triangles = static_cast<std::uint32_t>(scene.triangles.size());
        if (hit.primitive >= triangles)
            return sphere_point(scene, hit.primitive,
                                ray.origin + hit.t * ray.direction -
                                    scene.spheres[hit.primitive - triangles].center);
    }
    return triangle_point(scene, hit.primitive, hit.b1, hit.b2);
}

} // namespace fast
