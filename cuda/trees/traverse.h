#pragma once

// Traverses a wide tree along a ray. The queries, intersect and occluded, are in surfaces.h.

#include "cuda/trees/intersect.h"
#include "cuda/trees/slabs.h"
#include "cuda/trees/traversal_stack.h"
#include "cuda/trees/wide_tree.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <span>

namespace fast {

/// The default counter of nodes: counts nothing.
struct NotCounted {
    HD void operator()() const {}
};

/// Sorts in ascending order by a network of five exchanges [Knuth 1998, sec. 5.3.4].
HD inline void sort_four(std::uint32_t (&keys)[4])
{
    const auto order = [&](int i, int j) {
        const std::uint32_t smaller = keys[i] < keys[j] ? keys[i] : keys[j];
        const std::uint32_t larger = keys[i] < keys[j] ? keys[j] : keys[i];
        keys[i] = smaller;
        keys[j] = larger;
    };
    order(0, 1);
    order(2, 3);
    order(0, 2);
    order(1, 3);
    order(1, 2);
}

/// Calls test(group) for every group of triangles whose box the ray enters at a t <= limit, nearer
/// children first. `test` returns the new limit: the t of the closest hit so far, or a negative number
/// to stop. A tree that is one group is always tested. Calls count() for every node.
template <class Test, class Count = NotCounted>
HD void traverse(const WideTreeView& tree, const Ray& ray, const Test& test, const Count& count = {})
{
    if (tree.nodes.empty()) {
        if (!tree.groups.empty()) test(0);
        return;
    }
    const WideSlabs slabs{Slabs(ray, tree.bounds)};
    float limit = ray.t_max;
    TraversalStack stack;
    std::uint32_t next = 0;
    for (;;) {
        if (is_leaf(next)) {
            limit = test(next & ~leaf_bit);
            if (!stack.pop(limit, next)) return;
            continue;
        }
        count();
        const WideNode& node = tree.nodes[next];
        Lanes near;
        Lanes far;
        slabs.entries(node, limit, near, far);
        std::uint32_t keys[4];
        sort_keys(near, far, keys);
        sort_four(keys);
        if (keys[0] == not_ordered) {
            if (!stack.pop(limit, next)) return;
            continue;
        }
        for (int i = 3; i >= 1; --i)
            stack.push_if(keys[i] != not_ordered, node.children[keys[i] & 3],
                          std::bit_cast<float>(keys[i] & ~3u));
        next = node.children[keys[0] & 3];
    }
}

/// Kernel over rays.
template <class View>
struct IntersectRays {
    View tree;
    std::span<const Ray> rays;
    std::span<Hit> hits;

    HD void operator()(std::uint32_t i) const { hits[i] = intersect(tree, rays[i]); }
};

} // namespace fast
