#pragma once

// The surfaces of a scene, ready for two queries: the closest hit of a ray, and whether a ray hits
// anything.

#include "ref/trees/bvh.h"
#include "ref/trees/ray.h"
#include "ref/trees/traverse.h"
#include "scenes/contacts.h"

#include <optional>

namespace ref {

/// The triangles and spheres of a scene, prepared for ray queries. It keeps a reference to the scene,
/// which must outlive it. The tree changes only the time of a query, not its answer.
class Geometry {
public:
    /// `coincident`: surfaces that lie in the same place (scenes/contacts.h). Between two coincident
    /// surfaces that are not listed there, rounding decides which one a ray hits. Throws
    /// std::invalid_argument for a coordinate that is NaN or infinite: it names the first such
    /// primitive.
    explicit Geometry(const scenes::Scene& scene, const BuildOptions& tree = Builder::sah_leaf,
                      scenes::Coincidences coincident = {});
    [[nodiscard]] const scenes::Scene& scene() const { return *scene_; }
    [[nodiscard]] const Tree& tree() const { return tree_; }
    /// The diagonal of the box around all primitives: an upper bound on the distance between two
    /// surface points.
    [[nodiscard]] double diagonal() const { return diagonal_; }
    [[nodiscard]] const scenes::Coincidences& coincident() const { return coincident_; }
    /// The largest extent, along each axis, of the surfaces that a point of `primitive` may lie on:
    /// `own`, the extent of `primitive` itself, or the diagonal if other surfaces coincide with it.
    [[nodiscard]] Vec3 extent(std::uint32_t primitive, const Vec3& own) const
    {
        return coincident_.of(primitive).empty() ? own : Vec3(diagonal_);
    }
    /// An upper bound on the distance between `primitive` and the surfaces that coincide with it; 0 if
    /// there are none.
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

/// The hit of smallest t. Of several hits at the same t it is the one with the lowest primitive
/// number, and of coincident surfaces the one that scenes::meeting_rank puts first. Adds the work that
/// was done to `counts`, unless that is null.
std::optional<Hit> intersect(const Geometry& geometry, const Ray& ray,
                             TraversalCounts* counts = nullptr);

/// Whether the ray hits anything at all.
bool occluded(const Geometry& geometry, const Ray& ray, TraversalCounts* counts = nullptr);

/// Whether a ray that comes from direction `towards` (unit length) sees the surface at `point`, and
/// not another one that coincides with it.
bool sees_first(const Geometry& geometry, const SurfacePoint& point, const Vec3& towards);

/// The surface at `hit`, which must come from `intersect` on the same geometry and ray.
SurfacePoint surface_point(const Geometry& geometry, const Ray& ray, const Hit& hit);

/// The point of triangle number `triangle` with these weights of its vertices (>= 0, sum 1).
SurfacePoint triangle_point(const Geometry& geometry, std::uint32_t triangle, const Vec3& barycentric);

/// The point of sphere number `sphere` (the first is 0) in `direction` (any length) from its centre.
SurfacePoint sphere_point(const Geometry& geometry, std::uint32_t sphere, const Vec3& direction);

/// `point.position` moved off the surface by exactly its error bound, to the side that `direction`
/// (any length) points to. A ray that starts there cannot hit the surface that it leaves, nor one that
/// coincides with it. No constant has a unit, so the scale of the scene does not matter.
/// (docs/leaving-a-surface.md shows what a fixed distance does instead.)
Vec3 leave_surface(const SurfacePoint& point, const Vec3& direction);

/// The same for the end of a segment that starts elsewhere: the rounding along the segment is added.
/// `back`: the vector from `point` to the other end.
Vec3 end_at_surface(const SurfacePoint& point, const Vec3& back);

} // namespace ref
