#pragma once

// The binary tree of boxes over primitives that every builder returns.

#include "ref/trees/aabb.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ref {

/// Marks a missing node: the parent of the root, and the children of a leaf.
constexpr std::uint32_t no_node = 0xffff'ffff;

struct Node {
    std::array<std::uint32_t, 2> children{no_node, no_node};
    std::uint32_t parent = no_node;
    friend bool operator==(const Node&, const Node&) = default;
};

/// A binary tree with L leaves has L - 1 internal nodes. They come first; the root is node 0, and leaf
/// l is node L - 1 + l. Leaves are numbered from left to right, so that every node covers a contiguous
/// range of them. Leaf l holds primitives[leaf_begin[l]] to primitives[leaf_begin[l + 1] - 1]. A tree
/// over no primitives has no nodes; in a tree with one leaf, the leaf is the root.
struct Tree {
    std::vector<Node> nodes;
    std::vector<Aabb> bounds;              // one per node
    std::vector<std::uint32_t> leaf_begin; // L + 1 numbers
    std::vector<std::uint32_t> primitives;
    friend bool operator==(const Tree&, const Tree&) = default;

    [[nodiscard]] std::uint32_t leaf_count() const
    {
        return leaf_begin.empty() ? 0 : static_cast<std::uint32_t>(leaf_begin.size() - 1);
    }
    [[nodiscard]] std::uint32_t internal_count() const
    {
        return static_cast<std::uint32_t>(nodes.size()) - leaf_count();
    }
    [[nodiscard]] bool is_leaf(std::uint32_t node) const { return node >= internal_count(); }
    /// The number l of a leaf, given its node.
    [[nodiscard]] std::uint32_t leaf(std::uint32_t node) const { return node - internal_count(); }
};

} // namespace ref
