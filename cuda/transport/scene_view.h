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
template <class F>
struct alignas(8 * sizeof(F)) SurfaceOf {
    WordOf<F> material;
    WordOf<F> emitter;                  // or no_emitter
    F clearance = 0.0f;                 // triangle_clearance or sphere_clearance
    F edge_margin = 0.0f;               // of a triangle
    Vec3Of<F> normal = Vec3Of<F>(0.0f); // of a triangle, unit length
    WordOf<F> contacts = 0u;            // of SceneView::surface_contacts
};
using Surface = SurfaceOf<float>;
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
template <class F>
struct SurfacePointOf {
    Vec3Of<F> position;
    Vec3Of<F> normal; // unit, geometric: by winding for a triangle, outward for a sphere
    F clearance;      // the distance from the surface, along the normal, at which rays begin
                      // (clearance.h)
    WordOf<F> primitive;
};
using SurfacePoint = SurfacePointOf<float>;

/// The origin of a ray that leaves `point` in `direction` (of any length) and does not hit the same
/// surface again.
template <class F>
HD Vec3Of<F> leave_surface(const SurfacePointOf<F>& point, const Vec3Of<F>& direction)
{
    return leave_surface(point.position, point.normal, point.clearance, direction);
}

/// The same on the side of `facing`, which is the normal or its opposite.
template <class F>
HD Vec3Of<F> leave_to_side(const SurfacePointOf<F>& point, const Vec3Of<F>& facing)
{
    return point.position + point.clearance * facing;
}

/// The end of a segment of that `length` that comes to `point` from the side of `facing`, which is the
/// normal or its opposite.
template <class F>
HD Vec3Of<F> end_at_surface(const SurfacePointOf<F>& point, const Vec3Of<F>& facing, const F& length)
{
    return point.position + (point.clearance + clearance_per_length * length) * facing;
}

} // namespace fast
