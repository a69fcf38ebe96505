#pragma once

// Traversal of the binary tree that wide trees are made from. No renderer uses it: tests compare wide
// trees with it, and benchmarks measure what wide nodes gain.

#include "cuda/trees/intersect.h"
#include "cuda/trees/traverse.h"

#include <cstdint>
#include <limits>
#include <span>

namespace fast_trees_test {

/// A tree for traversal, at most `deepest_tree` deep. Triangles are in the order of leaves: leaf l
/// holds triangles[l].
struct TreeView {
    std::span<const fast::Node> nodes;
    std::span<const std::uint32_t> primitives; // by leaf: the number of its triangle
    std::span<const fast::Triangle> triangles; // by leaf
};

/// Kernel over leaves: brings triangles into the order of leaves.
struct OrderTriangles {
    std::span<const fast::Triangle> triangles;
    std::span<const std::uint32_t> primitives;
    std::span<fast::Triangle> ordered;

    HD void operator()(std::uint32_t leaf) const { ordered[leaf] = triangles[primitives[leaf]]; }
};

/// Calls test(leaf) for every leaf whose box the ray enters at a t <= limit, the nearer of two
/// children first. `test` returns the new limit: the t of the closest hit so far, or a negative number
/// to stop. In a tree over one primitive the only leaf is always tested. Calls count() for every node.
template <class Test, class Count = fast::NotCounted>
HD void traverse(const TreeView& tree, const fast::Ray& ray, const Test& test, const Count& count = {})
{
    if (tree.nodes.empty()) {
        if (!tree.primitives.empty()) test(0);
        return;
    }
    const fast::Aabb root = unite(tree.nodes[0].bounds[0], tree.nodes[0].bounds[1]);
    const fast::SlabsOf<float> slabs(fast::SlabRay(ray, root));
    float limit = ray.t_max;
    fast::TraversalStack stack;
    std::uint32_t next = 0;
    do {
        if (fast::is_leaf(next)) {
            limit = test(next & ~fast::leaf_bit);
            continue;
        }
        count();
        const fast::Node& node = tree.nodes[next];
        float entry[2];
        const bool entered[2] = {slabs.entered(node.bounds[0], limit, entry[0]),
                                 slabs.entered(node.bounds[1], limit, entry[1])};
        const int nearer = entry[1] < entry[0] ? 1 : 0;
        for (const int side : {1 - nearer, nearer})
            if (entered[side])
                stack.push(fast::TraversalStack::element(node.children[side], entry[side]));
    } while (stack.pop(limit, next));
}

/// The hit of smallest t; of several at the same t, that of the lowest primitive number.
HD inline fast::Hit intersect(const TreeView& tree, const fast::Ray& ray)
{
    const fast::ShearedRay sheared(ray);
    fast::Hit best{ray.t_max, fast::no_primitive, 0, 0};
    traverse(tree, ray, [&](std::uint32_t leaf) {
        fast::Hit hit{0, tree.primitives[leaf], 0, 0};
        if (intersect_triangle(sheared, tree.triangles[leaf], ray.t_max, hit) && comes_before(hit, best))
            best = hit;
        return best.t;
    });
    return best;
}

/// Whether the ray hits anything.
HD inline bool occluded(const TreeView& tree, const fast::Ray& ray)
{
    const fast::ShearedRay sheared(ray);
    bool found = false;
    traverse(tree, ray, [&](std::uint32_t leaf) {
        fast::Hit hit{};
        found = found || intersect_triangle(sheared, tree.triangles[leaf], ray.t_max, hit);
        return found ? -1.0f : ray.t_max;
    });
    return found;
}

/// Kernel over rays: 1 where anything is hit, 0 elsewhere.
template <class View>
struct TestOcclusion {
    View tree;
    std::span<const fast::Ray> rays;
    std::span<std::uint8_t> hits;

    HD void operator()(std::uint32_t i) const { hits[i] = occluded(tree, rays[i]) ? 1 : 0; }
};

} // namespace fast_trees_test
