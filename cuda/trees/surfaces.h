#pragma once

// Triangles and spheres together, with two queries: the closest hit of a ray, and whether a ray hits
// anything. Primitives are numbered consecutively, first the triangles, then the spheres
// (scenes::primitive_count).

#include "cuda/trees/hploc.h"
#include "cuda/trees/lbvh.h"
#include "cuda/trees/sphere.h"
#include "cuda/trees/traverse.h"
#include "cuda/trees/tree_builder.h"

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace fast {

/// The view of the surfaces that kernels use. In scenes without spheres, the spheres cost nothing.
template <bool has_spheres>
struct Surfaces {
    WideTreeView tree; // a sphere in a group has its number and no vertices
    std::span<const Sphere> spheres;
    std::uint32_t triangle_count;
};

/// Calls found(hit) for every primitive of a group that the ray hits at 0 < t < ray.t_max.
template <bool has_spheres, class Found>
HD void intersect_group(const Surfaces<has_spheres>& surfaces, std::uint32_t group, const Ray& ray,
                        const ShearedRay& sheared, const Found& found)
{
    const TriangleGroup& members = surfaces.tree.groups[group];
    intersect_group(sheared, members, ray.t_max, found);
    if constexpr (has_spheres)
        for (const std::uint32_t primitive : members.primitives) {
            if (primitive < surfaces.triangle_count || primitive == no_primitive) continue;
            Hit hit{0, primitive, 0, 0};
            if (intersect_sphere(ray, surfaces.spheres[primitive - surfaces.triangle_count], ray.t_max,
                                 hit))
                found(hit);
        }
}

/// Whether the ray has a position and a direction (no NaN). The comparisons of a traversal accept NaN,
/// which would lead other code to children that do not exist.
template <class F>
HD MaskOf<F> is_a_ray(const RayOf<F>& ray)
{
    const Vec3Of<F>& d = ray.direction;
    return is_finite(ray.origin) && is_finite(d) && (d.x != 0.0f || d.y != 0.0f || d.z != 0.0f);
}

/// The hit of smallest t; of several at the same t, that of the lowest primitive number. If nothing is
/// hit, or the ray has no position or no direction (is_a_ray), the primitive is no_primitive and t is
/// ray.t_max.
template <bool has_spheres>
HD Hit intersect(const Surfaces<has_spheres>& surfaces, const Ray& ray)
{
    Hit best{ray.t_max, no_primitive, 0, 0};
    if (!is_a_ray(ray)) return best;
    const ShearedRay sheared(ray);
    traverse(surfaces.tree, ray, [&](std::uint32_t group) {
        intersect_group(surfaces, group, ray, sheared, [&](const Hit& hit) {
            if (comes_before(hit, best)) best = hit;
        });
        return best.t;
    });
    return best;
}

/// Whether the ray hits anything; false if the ray has no position or no direction (is_a_ray).
template <bool has_spheres>
HD bool occluded(const Surfaces<has_spheres>& surfaces, const Ray& ray)
{
    if (!is_a_ray(ray)) return false;
    const ShearedRay sheared(ray);
    bool found = false;
    traverse(surfaces.tree, ray, [&](std::uint32_t group) {
        intersect_group(surfaces, group, ray, sheared, [&](const Hit& /*hit*/) { found = true; });
        return found ? -1.0f : ray.t_max;
    });
    return found;
}

/// Owns surfaces and a tree over them.
class SurfaceTree {
public:
    /// Copies the surfaces from the host into `memory` and builds the tree with `executor`. `memory`
    /// is that of its kernels, and must outlive the tree. Waits for the build. Throws
    /// std::invalid_argument for more than most_primitives; std::invalid_argument that names the first
    /// primitive with a coordinate that is NaN or infinite, or with a negative radius; and
    /// OutOfMemory.
    template <Executor E>
    SurfaceTree(Memory& memory, E& executor, std::span<const Triangle> triangles,
                std::span<const Sphere> spheres, TreeBuilder builder = default_tree_builder)
        : triangle_count_(checked(triangles.size(), spheres.size())), builder_(builder),
          spheres_(memory, spheres),
          tree_(builder == TreeBuilder::morton30 || builder == TreeBuilder::hploc30
                    ? build<std::uint32_t>(memory, executor, triangles)
                    : build<std::uint64_t>(memory, executor, triangles))
    {}

    /// Valid as long as the tree exists. `has_spheres` may be false only if there are no spheres.
    template <bool has_spheres>
    [[nodiscard]] Surfaces<has_spheres> view() const
    {
        return {tree_.view(), spheres_.all(), triangle_count_};
    }
    [[nodiscard]] bool has_spheres() const { return spheres_.size() > 0; }
    /// The builder of this tree: the one that was asked for, unless its tree was too deep.
    [[nodiscard]] TreeBuilder builder() const { return builder_; }
    /// The diagonal of the box around all surfaces (clearance.h); 0 if there are no surfaces.
    [[nodiscard]] float diagonal() const { return diagonal_; }

private:
    /// The number of triangles. Throws if there are too many triangles and spheres together.
    static std::uint32_t checked(std::size_t triangles, std::size_t spheres)
    {
        if (triangles > most_primitives || spheres > most_primitives - triangles)
            throw std::invalid_argument("a tree may have " + std::to_string(most_primitives) +
                                        " primitives, not " + std::to_string(triangles) +
                                        " triangles and " + std::to_string(spheres) + " spheres");
        return static_cast<std::uint32_t>(triangles);
    }

    /// `Code`: of 30 or 63 bits (morton.h).
    template <class Code, Executor E>
    WideTree build(Memory& memory, E& executor, std::span<const Triangle> triangles)
    {
        const auto sphere_count = static_cast<std::uint32_t>(spheres_.size());
        const std::uint32_t count = triangle_count_ + sphere_count;
        const Buffer<Triangle> given(memory, triangles);
        Buffer<Aabb> boxes(memory, count);
        executor(triangle_count_, BoundTriangles{given.all(), boxes.first(triangle_count_)});
        executor(sphere_count, BoundSpheres{spheres_.all(), boxes.all().subspan(triangle_count_)});

        MortonOrder<Code> order(memory, executor, count);
        order.build(executor, boxes.all());
        const std::vector<Aabb> on_host = boxes.read(count);
        throw_if_rejected(order.first_rejected(), on_host);
        Aabb bounds = empty_aabb();
        for (const Aabb& box : on_host) bounds = unite(bounds, box);
        if (count > 0) diagonal_ = glm::length(bounds.upper - bounds.lower);
        if (builder_ == TreeBuilder::hploc30 || builder_ == TreeBuilder::hploc63) {
            Hploc clustered(memory, count);
            clustered.build(executor, boxes.all(), order);
            WideTree wide(memory, executor, clustered.nodes(), clustered.divisions(), order.primitives(),
                          given.all());
            if (wide.levels() <= deepest_tree) return wide;
            // The height of the radix tree is bounded, that of this one is not (hploc.h).
            builder_ = builder_ == TreeBuilder::hploc30 ? TreeBuilder::morton30 : TreeBuilder::morton63;
        }
        RadixTree tree(memory, count);
        tree.build(executor, order.codes());
        tree.refit(executor, boxes.all(), order.primitives());
        const Divisions divisions(memory, executor, tree.nodes(), tree.leaf_links());
        return {memory,          executor,           std::as_const(tree).nodes(),
                divisions.all(), order.primitives(), given.all()};
    }

    std::uint32_t triangle_count_;
    TreeBuilder builder_;
    float diagonal_ = 0;
    Buffer<Sphere> spheres_;
    WideTree tree_;
};

/// A tree of surfaces; an executor may have a function of its own for it.
template <Executor E>
SurfaceTree surface_tree(Memory& memory, E& executor, std::span<const Triangle> triangles,
                         std::span<const Sphere> spheres, TreeBuilder builder)
{
    return {memory, executor, triangles, spheres, builder};
}

} // namespace fast
