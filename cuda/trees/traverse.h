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
/// `limit`. Of the children of a node the two nearest come first, in their order. `next`: a node, or a
/// group with leaf_bit; its own box is not tested. `test` returns the new limit: the t of the closest
/// hit so far, or a negative number to stop. Calls count() for every test of a node. This form keeps
/// every child that is still to be visited.
template <class Slabs, class Test, class Count = NotCounted>
HD void traverse_with_children(const WideTreeView& tree, std::uint32_t next, const Slabs& slabs,
                               float limit, const Test& test, const Count& count = {})
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
        // Most nodes have one or two children that the ray enters. Which of both cannot be predicted, so
        // there is no branch for it: a second child that is absent is farther away than any other.
        const int first = take_lane(entered);
        const std::uint64_t one = TraversalStack::element(node.children[first], near[first]);
        const std::int64_t absent = (std::int64_t{entered} - 1) >> 63; // -1 or 0
        const int second = take_lane(entered) & (most_children - 1);   // if absent, any number
        const std::uint64_t other = TraversalStack::element(node.children[second], near[second]) |
                                    static_cast<std::uint64_t>(absent);
        std::uint64_t nearest = one < other ? one : other; // map: traversal
        stack.push(one ^ other ^ nearest, 1 + static_cast<int>(absent));
        while (entered != 0) { // seldom: to sort them all would need more branches
            const int lane = take_lane(entered);
            const std::uint64_t element = TraversalStack::element(node.children[lane], near[lane]);
            const std::uint64_t nearer = element < nearest ? element : nearest;
            stack.push_in_order(element ^ nearest ^ nearer);
            nearest = nearer;
        }
        next = static_cast<std::uint32_t>(nearest);
    }
}

/// The same, keeping of each node on the way only which children are still to be visited: an element per
/// level. When a node comes up again, its boxes are tested again, against the smaller limit. That is
/// more work and less memory, of which every thread of a GPU has its own.
template <class Slabs, class Test, class Count = NotCounted>
HD void traverse_with_masks(const WideTreeView& tree, std::uint32_t next, const Slabs& slabs,
                            float limit, const Test& test, const Count& count = {})
{
    struct Unfinished {
        std::uint32_t node;
        LaneBits children; // not yet visited
    };
    constexpr LaneBits all = (1u << most_children) - 1;
    Unfinished stack[deepest_tree];
    int height = 0;
    LaneBits unvisited = all;
    for (;;) {
        if (is_leaf(next)) {
            limit = test(next & ~leaf_bit);
            if (limit < 0.0f) return;
        } else {
            count();
            const WideNode& node = tree.nodes[next];
            Lanes near;
            const LaneBits entered = slabs.entered(node, limit, near) & unvisited;
            int nearest = -1;
            float entry = 0.0f;
            for (int c = 0; c < most_children; ++c)
                if ((entered >> c & 1) != 0 && (nearest < 0 || near[c] < entry)) { // map: traversal
                    nearest = c;
                    entry = near[c];
                }
            if (nearest >= 0) {
                const LaneBits others = entered & ~(1u << nearest);
                if (others != 0) stack[height++] = {next, others};
                next = node.children[nearest];
                unvisited = all;
                continue;
            }
        }
        if (height == 0) return;
        --height;
        next = stack[height].node;
        unvisited = stack[height].children;
    }
}

/// The form for this processor.
template <class Slabs, class Test, class Count = NotCounted>
HD void traverse_below(const WideTreeView& tree, std::uint32_t next, const Slabs& slabs, float limit,
                       const Test& test, const Count& count = {})
{
    if constexpr (lanes_at_once)
        traverse_with_children(tree, next, slabs, limit, test, count);
    else
        traverse_with_masks(tree, next, slabs, limit, test, count);
}

/// The same for the whole tree. A tree that is one group is always tested.
template <class Test, class Count = NotCounted>
HD void traverse(const WideTreeView& tree, const Ray& ray, const Test& test, const Count& count = {})
{
    if (tree.nodes.empty()) {
        if (!tree.groups.empty()) test(0);
        return;
    }
    traverse_below(tree, 0, WideSlabs(SlabRay(ray, tree.bounds)), ray.t_max, test, count);
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
