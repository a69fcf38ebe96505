#pragma once

// Triangles of floats, trees over them, and the search without a tree.

#include "cuda/parallel/threaded_executor.h"
#include "cuda/trees/lbvh.h"
#include "cuda/trees/surfaces.h"
#include "tests/cuda/trees/binary_tree.h"
#include "tests/ref/trees/meshes.h"

#include <optional>
#include <span>
#include <vector>

namespace fast_trees_test {

/// The vertices of a mesh rounded to the nearest float: triangles that shared a vertex still share it.
inline std::vector<fast::Triangle> triangles_of(const trees_test::Mesh& mesh)
{
    std::vector<fast::Triangle> triangles;
    for (const auto& [a, b, c] : mesh.triangles)
        triangles.push_back({{fast::Vec3(mesh.vertices[a]), fast::Vec3(mesh.vertices[b]),
                              fast::Vec3(mesh.vertices[c])}});
    return triangles;
}

/// A tree over triangles, narrow and wide.
class Traceable {
public:
    explicit Traceable(std::span<const fast::Triangle> triangles)
        : tree_(memory_, fast::SerialExecutor{}, static_cast<std::uint32_t>(triangles.size()))
    {
        fast::SerialExecutor executor;
        const auto n = static_cast<std::uint32_t>(triangles.size());
        std::vector<fast::Aabb> boxes(n);
        executor(n, fast::BoundTriangles{triangles, boxes});
        tree_.build(executor, boxes);
        fast::throw_if_rejected(tree_.first_rejected(), boxes);
        ordered_.resize(n);
        executor(n, fast_trees_test::OrderTriangles{triangles, tree_.primitives(), ordered_});
        wide_.emplace(memory_, executor, triangles, std::span<const fast::Sphere>());
    }
    [[nodiscard]] fast_trees_test::TreeView narrow() const
    {
        return {tree_.nodes(), tree_.primitives(), ordered_};
    }
    [[nodiscard]] fast::Surfaces<false> wide() const { return wide_->view<false>(); }

private:
    fast::HostMemory memory_;
    fast::Lbvh<std::uint64_t> tree_;
    std::vector<fast::Triangle> ordered_;
    std::optional<fast::SurfaceTree> wide_;
};

/// The closest hit by testing every triangle.
inline fast::Hit linear_search(std::span<const fast::Triangle> triangles, const fast::Ray& ray)
{
    const fast::ShearedRay sheared(ray);
    fast::Hit best{ray.t_max, fast::no_primitive, 0, 0};
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        fast::Hit hit{0, i, 0, 0};
        if (intersect_triangle(sheared, triangles[i], ray.t_max, hit) && hit.t < best.t) best = hit;
    }
    return best;
}

} // namespace fast_trees_test
