#pragma once

// The queries of stages for many rays at once.

#include "cuda/parallel/prefetch.h"
#include "cuda/stages/floats_traverse.h"
#include "cuda/stages/trace_rays.h"

namespace fast {

/// Calls found(rays, t, primitive) for every primitive of a group and the rays of `here` that hit it at
/// 0 < t < limit.
template <bool has_spheres, class Found>
void intersect_group_together(const Surfaces<has_spheres>& surfaces, std::uint32_t group,
                              const RayOf<Floats>& rays, const ShearedRays& sheared, const Mask& here,
                              const Floats& limit, const Found& found)
{
    const TriangleGroup& members = surfaces.tree.groups[group];
    for (int i = 0; i < static_cast<int>(most_in_group) && members.primitives[i] != no_primitive; ++i) {
        const std::uint32_t primitive = members.primitives[i];
        Floats t;
        if constexpr (has_spheres)
            if (primitive >= surfaces.triangle_count) {
                const Sphere& sphere = surfaces.spheres[primitive - surfaces.triangle_count];
                const Mask hit = here && intersect_sphere(rays,
                                                          SphereOf<Floats>{Vec3Of<Floats>(sphere.center),
                                                                           Floats(sphere.radius)},
                                                          limit, t);
                if (any(hit)) found(hit, t, primitive);
                continue;
            }
        const Triangle triangle = members.triangle(i);
        const ShearedTriangles seen(sheared, triangle.vertices);
        const Mask candidates = here && seen.may_hit();
        if (none(candidates)) continue;
        const Mask hit = seen.hit(candidates, limit, t);
        if (any(hit)) found(hit, t, primitive);
    }
}

template <Needs needs>
HitOf<Floats> closest_hits(const SceneView<needs>& scene, const RayOf<Floats>& rays, const Mask& active)
{
    const Surfaces<needs.spheres>& surfaces = scene.geometry;
    HitOf<Floats> best{rays.t_max, Words(no_primitive), Floats(0.0f), Floats(0.0f)};
    const ShearedRays sheared(rays);
    const SlabRayOf<Floats> slab_rays(rays, surfaces.tree.bounds);
    SingleRays single(rays, slab_rays, sheared);
    const auto together = [&](std::uint32_t group, const Mask& here) {
        intersect_group_together(surfaces, group, rays, sheared, here, rays.t_max,
                                 [&](const Mask& hit, const Floats& t, std::uint32_t primitive) {
                                     // comes_before of cuda/trees/ray.h
                                     const Mask before =
                                         hit && (t < best.t ||
                                                 (t == best.t && Words(primitive) < best.primitive));
                                     best.t = select(before, t, best.t);
                                     best.primitive = select(before, Words(primitive), best.primitive);
                                 });
    };
    const auto alone = [&](std::uint32_t node, std::uint32_t here) {
        StoredLanes<Floats> t(best.t);
        StoredLanes<Words> primitive(best.primitive);
        for (; here != 0; here &= here - 1) {
            const int lane = std::countr_zero(here);
            const SingleRays::One one = single[lane];
            Hit hit{t[lane], primitive[lane], 0, 0};
            traverse_below(surfaces.tree, node, one.slabs, hit.t, [&](std::uint32_t group) {
                intersect_group(surfaces, group, one.ray, one.sheared, [&](const Hit& found) {
                    if (comes_before(found, hit)) hit = found;
                });
                return hit.t;
            });
            t.put(lane, hit.t);
            primitive.put(lane, hit.primitive);
            if (hit.primitive < surfaces.triangle_count) {
                prefetch(scene.triangles[hit.primitive]); // for the weights, below
                prefetch(scene.surfaces[hit.primitive]);  // for the next stage
            }
        }
        best.t = t.all();
        best.primitive = primitive.all();
    };
    traverse_together(surfaces.tree, slab_rays, active && is_a_ray(rays), best.t, together, alone);

    const Mask on_triangle = active && best.primitive != Words(no_primitive) &&
                             best.primitive < Words(surfaces.triangle_count);
    if (any(on_triangle)) {
        const TriangleOf<Floats> hit =
            at(scene.triangles, select(on_triangle, best.primitive, Words(0u)));
        Floats b1;
        Floats b2;
        ShearedTriangles(sheared, hit.vertices).weights(b1, b2);
        best.b1 = select(on_triangle, b1, best.b1);
        best.b2 = select(on_triangle, b2, best.b2);
    }
    return best;
}

template <Needs needs>
Mask occluded_rays(const SceneView<needs>& scene, const RayOf<Floats>& rays, const Mask& active)
{
    const Surfaces<needs.spheres>& surfaces = scene.geometry;
    const ShearedRays sheared(rays);
    const SlabRayOf<Floats> slab_rays(rays, surfaces.tree.bounds);
    SingleRays single(rays, slab_rays, sheared);
    Mask occluded = false;
    Floats limit = rays.t_max;
    const auto stop = [&](const Mask& hit) {
        occluded = occluded || hit;
        limit = select(hit, Floats(-1.0f), limit);
    };
    const auto together = [&](std::uint32_t group, const Mask& here) {
        intersect_group_together(
            surfaces, group, rays, sheared, here, rays.t_max,
            [&](const Mask& hit, const Floats& /*t*/, std::uint32_t) { stop(hit); });
    };
    const auto alone = [&](std::uint32_t node, std::uint32_t here) {
        std::uint32_t hit = 0;
        for (; here != 0; here &= here - 1) {
            const int lane = std::countr_zero(here);
            const SingleRays::One one = single[lane];
            traverse_below(surfaces.tree, node, one.slabs, one.ray.t_max, [&](std::uint32_t group) {
                intersect_group(surfaces, group, one.ray, one.sheared,
                                [&](const Hit& /*hit*/) { hit |= 1u << lane; });
                return (hit >> lane & 1) != 0 ? -1.0f : one.ray.t_max;
            });
        }
        if (hit != 0) stop(mask_of_bits(hit));
    };
    traverse_together(surfaces.tree, slab_rays, active && is_a_ray(rays), limit, together, alone);
    return occluded;
}

} // namespace fast
