#pragma once

// Computes boxes from the leaves up to the root: the box of an internal node follows once both
// children have theirs [Karras 2012, sec. 4; the counting follows Apetrei 2014].

#include "ref/trees/tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ref {

/// Sets all boxes of `tree` from those of the primitives. From every leaf a walk goes towards the
/// root. Of the two walks that arrive at a node the first stops there, since the other child has no
/// box yet; the second unites the boxes and goes on. `leaf_order` is the order in which the walks are
/// started, any permutation of the leaves; the boxes do not depend on it. (In parallel, the count must
/// be one atomic operation that also publishes the child's box. Otherwise the second walk may read the
/// box before it is written.)
inline void refit(Tree& tree, std::span<const Aabb> primitive_bounds,
                  std::span<const std::uint32_t> leaf_order)
{
    tree.bounds.resize(tree.nodes.size());
    for (std::uint32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) {
        Aabb bounds;
        for (std::uint32_t i = tree.leaf_begin[leaf]; i < tree.leaf_begin[leaf + 1]; ++i)
            bounds = unite(bounds, primitive_bounds[tree.primitives[i]]);
        tree.bounds[tree.internal_count() + leaf] = bounds;
    }
    std::vector<std::uint8_t> arrivals(tree.internal_count(), 0);
    for (const std::uint32_t leaf : leaf_order) {
        std::uint32_t node = tree.internal_count() + leaf;
        for (;;) {
            node = tree.nodes[node].parent;
            if (node == no_node || arrivals[node]++ == 0) break;
            const auto [left, right] = tree.nodes[node].children;
            tree.bounds[node] = unite(tree.bounds[left], tree.bounds[right]); // map: refit
        }
    }
}

/// The same with the leaves from left to right.
inline void refit(Tree& tree, std::span<const Aabb> primitive_bounds)
{
    std::vector<std::uint32_t> leaves(tree.leaf_count());
    for (std::uint32_t leaf = 0; leaf < tree.leaf_count(); ++leaf) leaves[leaf] = leaf;
    refit(tree, primitive_bounds, leaves);
}

} // namespace ref
