#pragma once

// Binary trees for tests of wide ones.

#include "cuda/trees/lbvh.h"
#include "cuda/trees/wide_tree.h"
#include "tests/cuda/trees/triangles.h"
#include "tests/ref/trees/boxes.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace fast_trees_test {

/// A narrow tree over random triangles, some of them coincident. `one_is_far`: so far away that all
/// others have the same code of 30 bits.
struct Narrow {
    Narrow(std::size_t n, trees_test::Random& random, bool one_is_far = false)
        : tree(memory, executor, static_cast<std::uint32_t>(n))
    {
        for (std::size_t i = 0; i < n; ++i) {
            const ref::Vec3 at = random.in_cube();
            const double size = random.magnitude(-3, 0);
            fast::Triangle triangle{};
            for (fast::Vec3& vertex : triangle.vertices)
                vertex = fast::Vec3(at + size * random.in_cube());
            triangles.push_back(i > 0 && random.below(8) == 0 ? triangles[random.below(i)] : triangle);
        }
        if (one_is_far && n > 0)
            for (fast::Vec3& vertex : triangles[0].vertices) vertex += fast::Vec3(1e4f);
        boxes.resize(n);
        executor(static_cast<std::uint32_t>(n), fast::BoundTriangles{triangles, boxes});
        tree.build(executor, boxes);
    }
    template <fast::Executor E>
    fast::WideTree widened(E& by)
    {
        const fast::Divisions divisions(memory, by, tree.nodes(), tree.leaf_links());
        return {memory, by, std::as_const(tree).nodes(), divisions.all(), tree.primitives(), triangles};
    }
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    std::vector<fast::Triangle> triangles;
    std::vector<fast::Aabb> boxes;
    fast::Lbvh<std::uint64_t> tree;
};

} // namespace fast_trees_test
