#pragma once

// Nodes of up to eight children: a third of the steps from the root to a leaf of a binary tree, and all
// boxes of a node are tested at once where the processor has vectors of floats [Wald, Benthin, Boulos
// 2008].

#include "cuda/parallel/lanes.h"
#include "cuda/trees/node.h"

#include <cstdint>
#include <limits>
#include <span>

namespace fast {

/// A leaf of a wide tree has at most so many primitives.
constexpr std::uint32_t most_in_group = lane_count;

/// A node of a wide tree has at most so many children.
constexpr int most_children = lane_count;

/// The children, their boxes coordinate by coordinate. A child that is absent is no_node, and its box is
/// one that no ray enters. Four cache lines.
struct alignas(64) WideNode {
    Lanes planes[6];                       // lower x, y, z; upper x, y, z
    std::uint32_t children[most_children]; // a wide node by its number, a group by its number and the
                                           // highest bit

    /// Of child c.
    [[nodiscard]] HD Aabb box(int c) const
    {
        return {{planes[0][c], planes[1][c], planes[2][c]}, {planes[3][c], planes[4][c], planes[5][c]}};
    }
};
static_assert(sizeof(WideNode) == 256);

/// Collects the leaves below `child`, from left to right. Returns their number, or most_in_group + 1 if
/// there are more than most_in_group.
HD inline std::uint32_t leaves_below(std::span<const Node> nodes, std::uint32_t child,
                                     std::uint32_t (&leaves)[most_in_group])
{
    std::uint32_t stack[most_in_group + 1] = {child}; // each stands for one leaf at least
    std::uint32_t height = 1;
    std::uint32_t count = 0;
    while (height > 0) {
        const std::uint32_t next = stack[--height];
        if (is_leaf(next)) {
            leaves[count++] = next & ~leaf_bit;
            continue;
        }
        if (count + height + 2 > most_in_group) return most_in_group + 1;
        stack[height++] = nodes[next].children[1];
        stack[height++] = nodes[next].children[0];
    }
    return count;
}

} // namespace fast
