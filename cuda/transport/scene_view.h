#pragma once

// A scene as kernels read it: spans into arrays. Data that are read together stand in one array. Lengths
// are those of the scaled scene, whose centre is the origin and whose diameter is between 1 and 2
// (scene_arrays.h).

#include "cuda/transport/bsdf.h"
#include "cuda/transport/camera.h"
#include "cuda/transport/emitter_kinds.h"
#include "cuda/transport/needs.h"
#include "cuda/trees/clearance.h"
#include "cuda/trees/surfaces.h"

namespace fast {

constexpr std::uint32_t no_emitter = 0xffff'ffff;

/// A plane through an end of paths that is not a surface, or so near such an end that floats cannot
/// decide on which side the end is. Adding `push` times a distance moves a point by that distance to the
/// side of `normal`, and parallel to the other planes of the end. Where the side is known, `normal` is 0
/// and `push` points to that side.
struct ContactPlane {
    Vec3 normal, push;
    float clearance; // by which rays must be moved (clearance.h), less the end's own distance; maybe < 0
};

/// The data of a primitive that shading needs. They are read at every vertex of a walk, so they fit in
/// one cache line.
struct alignas(32) Surface {
    std::uint32_t material;
    std::uint32_t emitter;      // or no_emitter
    float clearance = 0;        // triangle_clearance or sphere_clearance
    float edge_margin = 0;      // of a triangle
    Vec3 normal = {};           // of a triangle, unit length
    std::uint32_t contacts = 0; // of SceneView::surface_contacts
};
static_assert(sizeof(Surface) == 32);

/// Two adjacent ranges of SceneView::coincident: the surfaces that coincide with this one as floats, and
/// those so near that a segment which ends here may end beyond them. Most surfaces have neither and use
/// element 0.
struct SurfaceContacts {
    std::uint32_t first_coincident, coincident_count, near_count;
};

/// A surface that coincides with another one, or nearly does.
struct Coincident {
    std::uint32_t primitive;
    std::int32_t side;  // on which side of the other one it lies: 1 that of the normal; 0: on it
    float largest_size; // of the other one: the diameter of a sphere; the extent of a triangle, or of
                        // a surface that coincides with it
};

template <Needs needs>
struct SceneView {
    Surfaces<needs.spheres> geometry;
    std::span<const Triangle> triangles; // by primitive
    std::span<const Sphere> spheres;     // by primitive, less the triangles
    std::span<const Surface> surfaces;   // by primitive
    std::span<const Material> materials;
    std::span<const Emitter> emitters; // the environment is the last
    std::span<const float> cumulative; // sums of their probabilities, up to 1; none if all are 0
    std::span<const Light> lights;     // by emitter: its light, if it is one
    std::span<const SurfaceContacts> surface_contacts;
    std::span<const Coincident> coincident;
    std::span<const ContactPlane> contact_planes;
    std::span<const std::uint32_t> contact_triangles;
    EndContacts eye_contacts;
    bool has_environment;
    float radius; // of a sphere around all geometry, the centre of which is the origin
    Camera camera;
};

/// A point on a surface.
struct SurfacePoint {
    Vec3 position;
    Vec3 normal; // unit, geometric: by winding for a triangle, outward for a sphere
    float
        clearance; // the distance from the surface, along the normal, at which rays begin (clearance.h)
    std::uint32_t primitive;
};

/// The origin of a ray that leaves `point` in `direction` (of any length) and does not hit the same
/// surface again.
HD inline Vec3 leave_surface(const SurfacePoint& point, const Vec3& direction)
{
    return leave_surface(point.position, point.normal, point.clearance, direction);
}

/// The same on the side of `facing`, which is the normal or its opposite.
HD inline Vec3 leave_to_side(const SurfacePoint& point, const Vec3& facing)
{
    return point.position + point.clearance * facing;
}

/// The end of a segment of that `length` that comes to `point` from the side of `facing`, which is the
/// normal or its opposite.
HD inline Vec3 end_at_surface(const SurfacePoint& point, const Vec3& facing, float length)
{
    return point.position + (point.clearance + clearance_per_length * length) * facing;
}

} // namespace fast
