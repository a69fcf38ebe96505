#pragma once

// Surfaces that coincide, and an eye, point or spot light that lies on a surface: where rounding
// cannot decide, the rules of scenes/contacts.h do. In a scene without them, each costs one test of a
// count.

#include "cuda/transport/surface_point.h"

namespace fast {

/// The start of a ray that leaves an end of a path in `direction`: beyond the surfaces that the end
/// lies on, so that the ray does not hit them. It is also the end of a segment of that `length` that
/// comes to the path end from there.
template <Needs needs, class F>
HD Vec3Of<F> leave_end(const SceneView<needs>& scene, const Vec3& position, const EndContacts& contacts,
                       const Vec3Of<F>& direction, const F& length = F(0.0f))
{
    Vec3Of<F> origin(position);
    for (std::uint32_t i = 0; i < contacts.plane_count; ++i) {
        const ContactPlane& plane = scene.contact_planes[contacts.first_plane + i];
        const F clearance = greater(F(0.0f), plane.clearance + clearance_per_length * length);
        origin += select(glm::dot(direction, Vec3Of<F>(plane.normal)) < 0.0f, -clearance, clearance) *
                  Vec3Of<F>(plane.push);
    }
    return origin;
}

/// Whether the path end lies on that triangle: no light passes between the end and a point of the
/// triangle.
template <class F, Needs needs>
HD MaskOf<F> lies_on(const SceneView<needs>& scene, const EndContacts& contacts,
                     const WordOf<F>& primitive)
{
    MaskOf<F> found = false;
    for (std::uint32_t i = 0; i < contacts.triangle_count; ++i)
        found = found || primitive == WordOf<F>(scene.contact_triangles[contacts.first_triangle + i]);
    return found;
}

/// The rank of a surface of that material; see scenes::meeting_rank. `from_front`: the ray comes from
/// the side of the surface's normal.
HD inline std::uint32_t meeting_rank(const Material& material, bool from_front)
{
    if (material.kind == MaterialKind::emission) return from_front ? 0 : 3;
    return material.kind == MaterialKind::glass ? 2 : 1;
}

/// `hit` of `ray` is on one of several coincident surfaces. Returns the hit on the one that the ray
/// sees: the first along the ray, where doubles can tell although floats cannot; otherwise the one of
/// lowest rank; of equal ranks the one of lowest number.
template <Needs needs>
SELDOM HD Hit first_of_several(const SceneView<needs>& scene, Ray ray, Hit hit)
{
    const SurfaceContacts& contacts = scene.surface_contacts[scene.surfaces[hit.primitive].contacts];
    const auto triangles = static_cast<std::uint32_t>(scene.triangles.size());
    const auto from_front = [&](const Hit& h) {
        if (h.primitive >= triangles)
            return glm::dot(ray.origin + h.t * ray.direction -
                                scene.spheres[h.primitive - triangles].center,
                            ray.direction) < 0.0f;
        return glm::dot(scene.surfaces[h.primitive].normal, ray.direction) < 0.0f;
    };
    const auto rank = [&](const Hit& h) {
        return meeting_rank(scene.materials[scene.surfaces[h.primitive].material], from_front(h));
    };
    const ShearedRay sheared(ray);
    const bool front = from_front(hit);
    Hit first = hit;
    int first_depth = 0; // along the ray, relative to `hit`: before it, level with it, behind it
    std::uint32_t first_rank = rank(hit);
    for (std::uint32_t i = 0; i < contacts.coincident_count; ++i) {
        const Coincident& other = scene.coincident[contacts.first_coincident + i];
        const int depth = front ? -other.side : other.side;
        Hit candidate{hit.t, other.primitive, 0, 0}; // every ray hits a coincident sphere
        if (other.primitive < triangles &&
            !intersect_triangle(sheared, scene.triangles[other.primitive],
                                std::numeric_limits<float>::infinity(), candidate))
            continue;
        const std::uint32_t its_rank = rank(candidate);
        const bool before = depth != first_depth     ? depth < first_depth
                            : its_rank != first_rank ? its_rank < first_rank
                                                     : candidate.primitive < first.primitive;
        if (!before) continue;
        first = candidate;
        first_depth = depth;
        first_rank = its_rank;
    }
    return first;
}

/// The same for any hit, where `active`.
template <Needs needs, class F>
HD HitOf<F> first_of_coincident(const SceneView<needs>& scene, const RayOf<F>& ray, HitOf<F> hit,
                                const MaskOf<F>& active)
{
    if constexpr (!needs.coincident) return hit;
    if (scene.coincident.empty()) return hit;
    one_by_one(active && at(scene.surfaces, hit.primitive).contacts != WordOf<F>(0u), [&](auto lane) {
        put_lane(hit, lane, first_of_several(scene, lane_of(ray, lane), lane_of(hit, lane)));
    });
    return hit;
}

/// See sees_first.
template <Needs needs>
SELDOM HD bool sees_first_of_several(const SceneView<needs>& scene, SurfacePoint point, Vec3 towards)
{
    const SurfaceContacts& contacts = scene.surface_contacts[scene.surfaces[point.primitive].contacts];
    // From some distance, so that t is not near 0; but not farther away than the size of the surfaces.
    const float away = scene.coincident[contacts.first_coincident].largest_size;
    const Ray ray{point.position + away * towards, std::numeric_limits<float>::infinity(), -towards};
    const ShearedRay sheared(ray);
    const int from = glm::dot(towards, point.normal) < 0.0f ? -1 : 1;
    const auto triangles = static_cast<std::uint32_t>(scene.triangles.size());
    for (std::uint32_t i = 0; i < contacts.near_count; ++i) {
        const Coincident& other =
            scene.coincident[contacts.first_coincident + contacts.coincident_count + i];
        Hit hit{};
        if (other.side == from && (other.primitive >= triangles || // every ray hits
                                   intersect_triangle(sheared, scene.triangles[other.primitive],
                                                      std::numeric_limits<float>::infinity(), hit)))
            return false;
    }
    return first_of_coincident<needs, float>(scene, ray, Hit{away, point.primitive, 0, 0}, true)
               .primitive == point.primitive;
}

/// Whether a ray that comes from direction `towards` (unit length) sees the surface at `point`, and
/// not another surface that coincides with it or lies so close over it that a segment to the point may
/// end between them.
/// Where not `active` the result has no meaning.
template <Needs needs, class F>
HD MaskOf<F> sees_first(const SceneView<needs>& scene, const SurfacePointOf<F>& point,
                        const Vec3Of<F>& towards, const MaskOf<F>& active)
{
    MaskOf<F> first = true;
    if constexpr (!needs.coincident) return first;
    if (scene.coincident.empty()) return first;
    one_by_one(active && at(scene.surfaces, point.primitive).contacts != WordOf<F>(0u), [&](auto lane) {
        put_lane(first, lane,
                 sees_first_of_several(scene, lane_of(point, lane), lane_of(towards, lane)));
    });
    return first;
}

} // namespace fast
