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

/// Calls test(group) for every group of triangles at or below `next` whose box the ray enters at a t <=
/// `limit`, nearer children first. `next`: a node, or a group with leaf_bit; its own box is not tested.
/// `test` returns the new limit: the t of the closest hit so far, or a negative number to stop. Calls
/// count() for every node.
template <class Test, class Count = NotCounted>
HD void traverse_below(const WideTreeView& tree, std::uint32_t next, const WideSlabs& slabs, float limit,
                       const Test& test, const Count& count = {})
{
    TraversalStack stack;
    for (;;) {
        if (is_leaf(next)) {
            limit = test(next & ~leaf_bit);
            if (!stack.pop(limit, next)) return;
            continue;
        }
        count();
        const WideNode& node = tree.nodes[next];
        Lanes near;
        LaneBits entered = slabs.entered(node, limit, near);
        if (entered == 0) {
            if (!stack.pop(limit, next)) return;
            continue;
        }
        // Most nodes have one or two children that the ray enters.
        const int first = take_lane(entered);
        next = node.children[first];
        if (entered == 0) continue;
        const int second = take_lane(entered);
        if (entered == 0) {
            const bool in_order = near[first] <= near[second];
            stack.push(node.children[in_order ? second : first], near[in_order ? second : first]);
            next = node.children[in_order ? first : second];
            continue;
        }
        int pushed = 2;
        stack.push(next, near[first]);
        stack.push(node.children[second], near[second]);
        for (; entered != 0; ++pushed) {
            const int lane = take_lane(entered);
            stack.push(node.children[lane], near[lane]);
        }
        stack.sort_last(pushed);
        stack.pop(limit, next);
    }
}

/// The same for the whole tree. A tree that is one group is always tested.
template <class Test, class Count = NotCounted>
HD void traverse(const WideTreeView& tree, const Ray& ray, const Test& test, const Count& count = {})
{
    if (tree.nodes.empty()) {
        if (!tree.groups.empty()) test(0);
        return;
    }
    traverse_below(tree, 0, WideSlabs{Slabs(ray, tree.bounds)}, ray.t_max, test, count);
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
