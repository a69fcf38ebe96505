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
template <Needs needs, class F>
HD SurfacePointOf<F> triangle_point(const SceneView<needs>& scene, const WordOf<F>& triangle, F b1, F b2)
{
    const auto& v = at(scene.triangles, triangle).vertices;
    const Vec3Of<F> e1 = v[1] - v[0];
    const Vec3Of<F> e2 = v[2] - v[0];
    const SurfaceOf<F>& surface = at(scene.surfaces, triangle);
    move_off_edges(surface.edge_margin, b1, b2);
    SurfacePointOf<F> point{};
    point.primitive = triangle;
    point.position = v[0] + (b1 * e1 + b2 * e2);
    point.normal = surface.normal;
    point.clearance = clearance_at(point.position, point.normal, surface.clearance);
    return point;
}

/// The point of sphere number `sphere` (the first is 0 after the triangles) in `direction` (any length)
/// from its centre.
template <Needs needs, class F>
HD SurfacePointOf<F> sphere_point(const SceneView<needs>& scene, const WordOf<F>& primitive,
                                  const Vec3Of<F>& direction)
{
    const SphereOf<F>& sphere =
        at(scene.spheres, primitive - static_cast<std::uint32_t>(scene.triangles.size()));
    SurfacePointOf<F> point{};
    point.primitive = primitive;
    point.normal = glm::normalize(direction);
    point.position = sphere.center + sphere.radius * point.normal;
    point.clearance =
        clearance_at(point.position, point.normal, at(scene.surfaces, primitive).clearance);
    return point;
}

/// The surface at `hit`, which must be a hit of `ray`.
template <Needs needs, class F>
HD SurfacePointOf<F> surface_point(const SceneView<needs>& scene, const RayOf<F>& ray,
                                   const HitOf<F>& hit)
{
    if constexpr (needs.spheres) {
        const auto triangles = static_cast<std::uint32_t>(scene.triangles.size());
        const MaskOf<F> on_sphere = hit.primitive >= WordOf<F>(triangles);
        if (any(on_sphere)) {
            // Where there is no sphere the first one stands in; its point is not chosen.
            const WordOf<F> sphere = select(on_sphere, hit.primitive, WordOf<F>(triangles));
            const SurfacePointOf<F> on_it = sphere_point<needs, F>(
                scene, sphere,
                ray.origin + hit.t * ray.direction - at(scene.spheres, sphere - triangles).center);
            if (none(!on_sphere)) return on_it;
            return select(on_sphere, on_it,
                          triangle_point<needs, F>(
                              scene, select(on_sphere, WordOf<F>(0u), hit.primitive), hit.b1, hit.b2));
        }
    }
    return triangle_point<needs, F>(scene, hit.primitive, hit.b1, hit.b2);
}

} // namespace fast
