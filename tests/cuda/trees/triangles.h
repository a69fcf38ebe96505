#pragma once

// Triangles of floats, trees over them, and the search without a tree.

#include "cuda/parallel/threaded_executor.h"
#include "cuda/trees/lbvh.h"
#include "cuda/trees/surfaces.h"
#include "tests/ref/trees/meshes.h"

#include <optional>
#include <span>
#include <vector>

namespace cuda_test {

/// The vertices of a mesh to the nearest float: triangles that shared one share it still.
inline std::vector<gpu::Triangle> triangles_of(const trees_test::Mesh& mesh)
{
    std::vector<gpu::Triangle> triangles;
    for (const auto& [a, b, c] : mesh.triangles)
        triangles.push_back(
            {{gpu::Vec3(mesh.vertices[a]), gpu::Vec3(mesh.vertices[b]), gpu::Vec3(mesh.vertices[c])}});
    return triangles;
}

/// A tree over triangles, narrow and wide.
class Traceable {
public:
    explicit Traceable(std::span<const gpu::Triangle> triangles)
        : tree_(memory_, gpu::SerialExecutor{}, static_cast<std::uint32_t>(triangles.size()))
    {
        gpu::SerialExecutor executor;
        const auto n = static_cast<std::uint32_t>(triangles.size());
        std::vector<gpu::Box> boxes(n);
        executor(n, gpu::BoundTriangles{triangles, boxes});
        tree_.build(executor, boxes);
        gpu::throw_if_rejected(tree_.first_rejected(), boxes);
        ordered_.resize(n);
        executor(n, gpu::OrderTriangles{triangles, tree_.primitives(), ordered_});
        wide_.emplace(memory_, executor, triangles, std::span<const gpu::Sphere>());
    }
    [[nodiscard]] gpu::TreeView narrow() const { return {tree_.nodes(), tree_.primitives(), ordered_}; }
    [[nodiscard]] gpu::Surfaces<false> wide() const { return wide_->view<false>(); }

private:
    gpu::HostMemory memory_;
    gpu::Lbvh<std::uint64_t> tree_;
    std::vector<gpu::Triangle> ordered_;
    std::optional<gpu::SurfaceTree> wide_;
};

/// The closest hit by testing every triangle.
inline gpu::Hit linear_search(std::span<const gpu::Triangle> triangles, const gpu::Ray& ray)
{
    const gpu::ShearedRay sheared(ray);
    gpu::Hit best{ray.t_max, gpu::no_primitive, 0, 0};
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        gpu::Hit hit{0, i, 0, 0};
        if (intersect_triangle(sheared, triangles[i], ray.t_max, hit) && hit.t < best.t) best = hit;
    }
    return best;
}

} // namespace cuda_test
