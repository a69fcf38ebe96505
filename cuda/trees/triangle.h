#pragma once

// Triangles and their boxes.

#include "cuda/parallel/number.h"
#include "cuda/trees/aabb.h"

#include <cstdint>
#include <limits>
#include <span>

namespace fast {

template <class F>
struct TriangleOf {
    Vec3Of<F> vertices[3];
};
using Triangle = TriangleOf<float>;

/// Kernel over triangles. Minimum and maximum would ignore a vertex that is NaN. So a triangle with
/// NaN gets a box of NaN, and the tree build rejects it by its number.
struct BoundTriangles {
    std::span<const Triangle> triangles;
    std::span<Aabb> boxes;

    HD void operator()(std::uint32_t i) const
    {
        const auto& v = triangles[i].vertices;
        const Aabb box{glm::min(glm::min(v[0], v[1]), v[2]), glm::max(glm::max(v[0], v[1]), v[2])};
        const bool finite = is_finite(v[0]) && is_finite(v[1]) && is_finite(v[2]);
        boxes[i] = finite ? box : Aabb{Vec3(std::numeric_limits<float>::quiet_NaN()), box.upper};
    }
};

} // namespace fast
