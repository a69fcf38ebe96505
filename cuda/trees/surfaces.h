#pragma once

// Triangles and spheres together, as a renderer asks about them: what does a ray hit first, and does it
// hit anything? Primitives are numbered through, first the triangles, then the spheres
// (scenes::primitive_count).

#include "cuda/trees/lbvh.h"
#include "cuda/trees/sphere.h"
#include "cuda/trees/traverse.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gpu {

/// What kernels need of the surfaces. Where there are no spheres they cost nothing.
template <bool has_spheres>
struct Surfaces {
    WideTreeView tree; // the triangle of a leaf that is a sphere is none, and is not read
    std::span<const Sphere> spheres;
    std::uint32_t triangle_count;
};

/// If the ray hits the primitive of a leaf at 0 < t < `limit`: sets all of `hit`.
template <bool has_spheres>
HD bool intersect_leaf(const Surfaces<has_spheres>& surfaces, std::uint32_t leaf, const Ray& ray,
                       const ShearedRay& sheared, float limit, Hit& hit)
{
    hit.primitive = surfaces.tree.primitives[leaf];
    if constexpr (has_spheres)
        if (hit.primitive >= surfaces.triangle_count)
            return intersect_sphere(ray, surfaces.spheres[hit.primitive - surfaces.triangle_count],
                                    limit, hit);
    return intersect_triangle(sheared, surfaces.tree.triangles[leaf], limit, hit);
}

/// The hit of smallest t; of several at the same t, that of the lowest primitive number. Where nothing
/// is hit its primitive is no_primitive and its t that of the ray's end.
template <bool has_spheres>
HD Hit closest_hit(const Surfaces<has_spheres>& surfaces, const Ray& ray)
{
    const ShearedRay sheared(ray);
    Hit best{ray.t_max, no_primitive, 0, 0};
    traverse(surfaces.tree, ray, [&](std::uint32_t leaf) {
        Hit hit{};
        if (intersect_leaf(surfaces, leaf, ray, sheared, ray.t_max, hit) && comes_before(hit, best))
            best = hit;
        return best.t;
    });
    return best;
}

/// Whether the ray hits anything.
template <bool has_spheres>
HD bool any_hit(const Surfaces<has_spheres>& surfaces, const Ray& ray)
{
    const ShearedRay sheared(ray);
    bool found = false;
    traverse(surfaces.tree, ray, [&](std::uint32_t leaf) {
        Hit hit{};
        found = found || intersect_leaf(surfaces, leaf, ray, sheared, ray.t_max, hit);
        return found ? -1.0f : ray.t_max;
    });
    return found;
}

/// Kernel over leaves: which primitive each is, and its triangle, if it is one.
struct FillLeaves {
    std::span<const Triangle> triangles;
    std::span<const std::uint32_t> sorted;
    std::span<std::uint32_t> primitives;
    std::span<Triangle> ordered;

    HD void operator()(std::uint32_t leaf) const
    {
        primitives[leaf] = sorted[leaf];
        if (sorted[leaf] < triangles.size()) ordered[leaf] = triangles[sorted[leaf]];
    }
};

/// Owns surfaces and a tree over them.
class SurfaceTree {
public:
    /// Copies the surfaces from the host and builds, by `executor`, into `memory`, which is that of its
    /// kernels and must outlive the tree. Waits for the build. Throws std::invalid_argument that names
    /// the first primitive that has a coordinate that is NaN or infinite, or a negative radius;
    /// OutOfMemory.
    template <Executor E>
    SurfaceTree(Memory& memory, E& executor, std::span<const Triangle> triangles,
                std::span<const Sphere> spheres)
        : triangle_count_(static_cast<std::uint32_t>(triangles.size())),
          primitive_count_(triangle_count_ + static_cast<std::uint32_t>(spheres.size())),
          spheres_(memory, spheres), primitives_(memory, primitive_count_),
          ordered_(memory, primitive_count_),
          nodes_(memory, primitive_count_ == 0 ? 0 : primitive_count_ - 1)
    {
        const Buffer<Triangle> given(memory, triangles);
        Buffer<Box> boxes(memory, primitive_count_);
        const std::span<Box> all = boxes.all();
        executor(triangle_count_, BoundTriangles{given.all(), all.first(triangle_count_)});
        executor(static_cast<std::uint32_t>(spheres.size()),
                 BoundSpheres{spheres_.all(), all.subspan(triangle_count_)});

        Lbvh<std::uint64_t> tree(memory, executor, primitive_count_);
        tree.build(executor, all);
        executor(primitive_count_,
                 FillLeaves{given.all(), tree.primitives(), primitives_.all(), ordered_.all()});
        executor(static_cast<std::uint32_t>(nodes_.size()), WidenNodes{tree.nodes(), nodes_.all()});

        const std::vector<Box> on_host = boxes.read(primitive_count_);
        throw_if_rejected(tree.first_rejected(), on_host);
        Box bounds = empty_box();
        for (const Box& box : on_host) bounds = unite(bounds, box);
        if (!on_host.empty()) diagonal_ = glm::length(bounds.upper - bounds.lower);
    }

    /// Stays good while the tree lives. With `has_spheres` false there must be none.
    template <bool has_spheres>
    [[nodiscard]] Surfaces<has_spheres> view() const
    {
        return {{nodes_.all(), primitives_.all(), ordered_.all()}, spheres_.all(), triangle_count_};
    }
    [[nodiscard]] bool has_spheres() const { return spheres_.size() > 0; }
    /// Of the box around all surfaces (clearance.h); 0 where there are none.
    [[nodiscard]] float diagonal() const { return diagonal_; }

private:
    std::uint32_t triangle_count_;
    std::uint32_t primitive_count_;
    Buffer<Sphere> spheres_;
    Buffer<std::uint32_t> primitives_;
    Buffer<Triangle> ordered_;
    Buffer<WideNode> nodes_;
    float diagonal_ = 0;
};

} // namespace gpu
