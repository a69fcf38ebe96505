#pragma once

// The binary radix tree over sorted keys, one thread per internal node [Karras 2012, sec. 3 and 4].
//
// Names follow the paper: delta (length of the longest common prefix), d (direction of the range), l
// (its length), s (distance of the split), gamma (its position), i and j (ends of the range). A key is
// a code followed by its index.

#include "cuda/trees/node.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <span>

namespace fast {

/// delta(i, j): the length of the longest common prefix of keys i and j; -1 if there is no key j.
template <class Code>
HD int common_prefix(std::span<const Code> codes, std::int32_t i, std::int32_t j)
{
    if (j < 0 || j >= static_cast<std::int32_t>(codes.size())) return -1;
    const Code a = codes[static_cast<std::uint32_t>(i)];
    const Code b = codes[static_cast<std::uint32_t>(j)];
    if (a != b) return std::countl_zero(static_cast<Code>(a ^ b)); // map: delta
    // Equal codes: their indices decide, below every bit of the code [Karras 2012, sec. 4].
    // map: delta-ties
    return std::numeric_limits<Code>::digits + std::countl_zero(static_cast<std::uint32_t>(i ^ j));
}

/// Kernel over internal nodes (n codes have n - 1): finds the range of a node and its split, and links
/// the node with its children. The boxes are set by the refit.
template <class Code>
struct BuildRadixTree {
    std::span<const Code> codes; // sorted; at most most_primitives
    std::span<Node> nodes;
    std::span<std::uint32_t> leaf_links;

    HD void operator()(std::uint32_t index) const
    {
        const auto i = static_cast<std::int32_t>(index);
        // The range extends towards the neighbour with the longer common prefix. The other neighbour
        // belongs to a sibling; its delta is a strict lower bound on the prefix that the keys of this
        // node share.
        const int d = delta(i, i + 1) > delta(i, i - 1) ? 1 : -1; // map: range-direction
        const int delta_min = delta(i, i - d);

        // An upper bound for the length, at most twice too long; then the bits of the length from the
        // highest. No sum here exceeds 3 n.
        std::int32_t l_max = 2;
        while (delta(i, i + l_max * d) > delta_min) l_max *= 2;
        std::int32_t l = 0;
        for (std::int32_t t = l_max / 2; t >= 1; t /= 2)
            if (delta(i, i + (l + t) * d) > delta_min) l += t; // map: range-length
        const std::int32_t j = i + l * d;

        // The farthest key whose common prefix with key i is longer than that of key j.
        const int delta_node = delta(i, j);
        std::int32_t s = 0;
        for (std::int32_t t = l; t > 1;) {
            t -= t / 2;                                         // ceil(l / 2), ceil(l / 4), ..., 1
            if (delta(i, i + (s + t) * d) > delta_node) s += t; // map: split
        }
        const std::int32_t gamma = i + s * d - (d < 0 ? 1 : 0);

        const std::int32_t first = d > 0 ? i : j;
        const std::int32_t last = d > 0 ? j : i;
        link(index, 0, gamma, first == gamma);
        link(index, 1, gamma + 1, last == gamma + 1);
        nodes[index].arrivals = 0;
        if (index == 0) nodes[0].link = no_node;
    }

private:
    [[nodiscard]] HD int delta(std::int32_t i, std::int32_t j) const
    {
        return common_prefix(codes, i, j);
    }

    /// The child next to the split: the leaf or the internal node with number `at_split`.
    HD void link(std::uint32_t parent, std::uint32_t side, std::int32_t at_split, bool to_leaf) const
    {
        const auto number = static_cast<std::uint32_t>(at_split);
        nodes[parent].children[side] = to_leaf ? number | leaf_bit : number; // map: children
        (to_leaf ? leaf_links[number] : nodes[number].link) = link_to(parent, side);
    }
};

/// Kernel of one index, for a tree over one primitive: its leaf is the root.
struct UnlinkOnlyLeaf {
    std::span<std::uint32_t> leaf_links;

    HD void operator()(std::uint32_t leaf) const { leaf_links[leaf] = no_node; }
};

} // namespace fast
