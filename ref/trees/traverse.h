#pragma once

// Traversal of a tree by a ray: it visits every box that the ray enters, the nearer child first.

#include "ref/trees/ray.h"
#include "ref/trees/rounding.h"
#include "ref/trees/tree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory_resource>
#include <vector>

namespace ref {

/// A ray prepared for tests against boxes, slab by slab [Kay and Kajiya 1986].
///
/// The box test must not miss a hit of intersect.h, whose test acts on primitives perturbed by
/// rounding. Let u be the unit roundoff, o the origin, and m the largest coordinate of b - o over all
/// corners b of the root's box. The point of a hit, o + t d for the t that is reported, lies within 15
/// u m of the triangle's box on every axis: 7 u m for the shear (see geometry.cpp), and 8 u m for the
/// roundings of the weights and of the sum in t; everything else is exact for the perturbed triangle.
/// For a sphere, |l| and c carry 12 u m. Here the subtraction b - o, the reciprocal and the product
/// carry 1 u m each. So boxes are padded by 32 u m on each side, and no comparison needs a tolerance.
/// (For float, and for boxes alone, see [Ize 2013].)
class Slabs {
public:
    Slabs(const Ray& ray, const Aabb& root) : origin_(ray.origin), reciprocal_(1.0 / ray.direction)
    {
        const Vec3 reach = glm::max(glm::abs(root.lower - origin_), glm::abs(root.upper - origin_));
        padding_ = Vec3(32 * unit_roundoff * std::max({reach.x, reach.y, reach.z}));
    }

    /// The smallest t >= 0 at which the ray is in `box`, or infinity if it misses the box.
    [[nodiscard]] double entry(const Aabb& box) const
    {
        const Vec3 lower = (box.lower - origin_ - padding_) * reciprocal_;
        const Vec3 upper = (box.upper - origin_ + padding_) * reciprocal_;
        double near = 0;
        double far = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const bool descending = reciprocal_[axis] < 0; // a direction of -0 gives -infinity: true
            const double enter = descending ? upper[axis] : lower[axis];
            const double leave = descending ? lower[axis] : upper[axis];
            // A ray in a face of the slab gives 0 * infinity = NaN, which both comparisons ignore.
            if (enter > near) near = enter;
            if (leave < far) far = leave;
        }
        return near <= far ? near : std::numeric_limits<double>::infinity(); // map: slabs
    }

private:
    Vec3 origin_;
    Vec3 reciprocal_;
    Vec3 padding_;
};

/// Counts of the nodes and primitives that traversals tested.
struct TraversalCounts {
    std::uint64_t nodes = 0;      // boxes that the ray entered, leaves included
    std::uint64_t primitives = 0; // primitives tested
    TraversalCounts& operator+=(const TraversalCounts& other)
    {
        nodes += other.nodes;
        primitives += other.primitives;
        return *this;
    }
};

/// Calls `test(primitive)` for the primitives of every leaf whose box the ray enters at a t <= limit.
/// The limit starts at t_max. `test` returns the new limit: the t of the closest hit so far, or a
/// negative number to stop.
///
/// A box that the ray enters exactly at the limit is visited too, because it may hold a primitive of
/// lower number at the same t. The stack grows as needed, so the tree may have any depth.
template <typename Test>
TraversalCounts traverse(const Tree& tree, const Ray& ray, Test test)
{
    TraversalCounts counts;
    if (tree.nodes.empty()) return counts;
    const Slabs slabs(ray, tree.bounds[0]);
    double limit = ray.t_max;

    struct Entry {
        double t;
        std::uint32_t node;
    };
    std::array<std::byte, 64 * sizeof(Entry)> buffer; // enough for most trees; then the heap is used
    std::pmr::monotonic_buffer_resource memory(buffer.data(), buffer.size());
    std::pmr::vector<Entry> stack(&memory);
    stack.reserve(64);

    const auto push = [&](const Entry& entry) {
        if (entry.t <= limit && entry.t < std::numeric_limits<double>::infinity())
            stack.push_back(entry);
    };
    push({slabs.entry(tree.bounds[0]), 0});
    while (!stack.empty()) {
        const Entry entry = stack.back();
        stack.pop_back();
        if (!(entry.t <= limit)) continue; // a closer hit has been found since
        ++counts.nodes;
        if (tree.is_leaf(entry.node)) {
            const std::uint32_t leaf = tree.leaf(entry.node);
            for (std::uint32_t i = tree.leaf_begin[leaf]; i < tree.leaf_begin[leaf + 1]; ++i) {
                ++counts.primitives;
                limit = test(tree.primitives[i]);
            }
            continue;
        }
        const auto [left, right] = tree.nodes[entry.node].children;
        const Entry a{slabs.entry(tree.bounds[left]), left};
        const Entry b{slabs.entry(tree.bounds[right]), right};
        push(a.t <= b.t ? b : a); // map: traversal
        push(a.t <= b.t ? a : b);
    }
    return counts;
}

} // namespace ref
