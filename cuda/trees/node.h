#pragma once

// Nodes of a binary tree. Only internal nodes are stored, each with the boxes of its two children: so a
// ray tests both boxes with one aligned read of 64 bytes, and the thread that computes a box writes it
// once, to where it will be read.

#include "cuda/trees/aabb.h"

#include <cstdint>
#include <span>

namespace fast {

constexpr std::uint32_t no_node = 0xffff'ffff;

/// More primitives than this could overflow the search for a range (radix_tree.h).
constexpr std::uint32_t most_primitives = 1u << 29;

/// A radix tree is no deeper than this: code bits and the bits of an index, 63 + 29.
constexpr int deepest_tree = 92;

/// A child as its parent refers to it: an internal node by its number, a leaf by its number and the
/// highest bit.
constexpr std::uint32_t leaf_bit = 0x8000'0000;

HD constexpr bool is_leaf(std::uint32_t child)
{
    return (child & leaf_bit) != 0;
}

/// A parent as its child refers to it: twice the number of its parent, plus 1 for the right child.
HD constexpr std::uint32_t link_to(std::uint32_t parent, std::uint32_t side)
{
    return parent << 1 | side;
}

/// Internal node i of a tree over n primitives, 0 <= i < n - 1; node 0 is the root. Leaf l holds
/// primitives[l], leaves being numbered from left to right, and has no node. A tree over one primitive
/// has none at all.
struct alignas(64) Node {
    Aabb bounds[2];
    std::uint32_t children[2];
    std::uint32_t link;     // to the parent; no_node for the root
    std::uint32_t arrivals; // 0 but during a refit
};
static_assert(sizeof(Node) == 64);

/// The child that a link (Node::link) leads to.
HD inline std::uint32_t child_at(std::span<const Node> nodes, std::uint32_t link)
{
    return nodes[link >> 1].children[link & 1];
}

/// Its box.
HD inline const Aabb& box_at(std::span<const Node> nodes, std::uint32_t link)
{
    return nodes[link >> 1].bounds[link & 1];
}

} // namespace fast
