#pragma once

// Whether a binary tree of the fast path (cuda/trees/node.h) is valid, in little more memory than the
// tree: for trees of very many primitives.

#include "cuda/trees/node.h"

#include <cstdint>
#include <span>
#include <string>

namespace extremes {

/// A binary tree of the fast path and what it is built over.
struct BinaryTree {
    std::span<const fast::Node> nodes;
    std::span<const std::uint32_t> leaf_links; // one per leaf
    std::span<const std::uint32_t> primitives; // by leaf
    std::span<const fast::Aabb> boxes;         // by primitive
};

struct CheckedTree {
    std::string fault; // the first thing that is wrong; empty if the tree is valid
    int depth = 0;     // edges from the root to the deepest leaf, if it is valid
};

/// In a valid tree the leaves hold each primitive once; every node and leaf but the root is the child of
/// the one node that it is linked to; all can be reached from the root; and every box is, bit for bit,
/// the union of the boxes below it. `leaves_in_order`: a walk from left to right also meets the leaves
/// in the order of their numbers, as it must in a radix tree. Any contents are safe: every number is
/// checked before it is followed.
CheckedTree checked(const BinaryTree& tree, bool leaves_in_order);

} // namespace extremes
