#pragma once

// The surfaces of a scene behind two questions: what does this ray hit first, and does it hit anything?

#include "ref/trees/bvh.h"
#include "ref/trees/ray.h"
#include "ref/trees/traverse.h"
#include "scenes/contacts.h"

#include <optional>

namespace ref {

/// A scene's triangles and spheres, made ready for ray queries. Keeps a reference to the scene, which
/// must outlive it. The answers do not depend on the builder, only the time they take.
class Geometry {
public:
    /// `coincident`: surfaces that rays meet together (scenes/contacts.h). Where none are named,
    /// rounding decides which of two coincident surfaces a ray hits. Throws std::invalid_argument that
    /// names the first primitive with a coordinate that is no number.
    explicit Geometry(const scenes::Scene& scene, Builder builder = Builder::sah_leaf,
                      scenes::Coincidences coincident = {});
    [[nodiscard]] const scenes::Scene& scene() const { return *scene_; }
    [[nodiscard]] const Tree& tree() const { return tree_; }
    /// Of the box around all primitives: an upper bound on the distance between two points of surfaces.
    [[nodiscard]] double diagonal() const { return diagonal_; }
    [[nodiscard]] const scenes::Coincidences& coincident() const { return coincident_; }
    /// Of the surfaces that a point of `primitive` may lie on, the largest extent along each axis:
    /// `own`, its own one, unless others coincide with it.
    [[nodiscard]] Vec3 extent(std::uint32_t primitive, const Vec3& own) const
    {
        return coincident_.of(primitive).empty() ? own : Vec3(diagonal_);
    }
    /// How far from `primitive` the surfaces may lie that coincide with it; 0 if there are none.
    [[nodiscard]] double coincidence_slack(std::uint32_t primitive) const
    {
        return coincident_.of(primitive).empty() ? 0 : slack_;
    }

private:
    const scenes::Scene* scene_;
    Tree tree_;
    scenes::Coincidences coincident_;
    double diagonal_ = 0;
    double slack_ = 0;
};

/// The hit of smallest t; of several at the same t, that of the lowest primitive number, and of surfaces
/// that coincide the one that scenes::meeting_rank puts first. Adds to `counts`, if there is one, what
/// it took.
std::optional<Hit> intersect(const Geometry& geometry, const Ray& ray,
                             TraversalCounts* counts = nullptr);

/// Whether the ray hits anything at all.
bool occluded(const Geometry& geometry, const Ray& ray, TraversalCounts* counts = nullptr);

/// Whether a ray that comes from direction `towards` (unit length) sees the surface at `point`, and not
/// one that coincides with it.
bool sees_first(const Geometry& geometry, const SurfacePoint& point, const Vec3& towards);

/// The surface at `hit`, which must come from `intersect` on the same geometry and ray.
SurfacePoint surface_point(const Geometry& geometry, const Ray& ray, const Hit& hit);

/// The point of triangle number `triangle` with these weights of its vertices (>= 0, sum 1).
SurfacePoint triangle_point(const Geometry& geometry, std::uint32_t triangle, const Vec3& barycentric);

/// The point of sphere number `sphere` (the first is 0) in `direction` (any length) from its centre.
SurfacePoint sphere_point(const Geometry& geometry, std::uint32_t sphere, const Vec3& direction);

/// `point.position` moved off the surface by just its error bound, to the side that `direction` (any
/// length) points to: a ray from there cannot meet the surface that it leaves, nor one that coincides
/// with it. No constant is involved, so scenes of any scale behave alike.
Vec3 leave_surface(const SurfacePoint& point, const Vec3& direction);

/// The same for the end of a segment that comes from elsewhere: rounding on the way counts, too. `back`:
/// the vector from `point` to the other end.
Vec3 end_at_surface(const SurfacePoint& point, const Vec3& back);

} // namespace ref
