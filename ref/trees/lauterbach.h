#pragma once

// The radix tree of radix_tree.h, built from the top down by recursion: each range is split where its
// highest differing bit changes from 0 to 1 [Lauterbach 2009, sec. 3.1]. Slow and short; the tests
// compare radix_tree with it.

#include "ref/trees/radix_tree.h"

#include <algorithm>

namespace ref {

/// The last key of the left half of the sorted keys first to last (first < last). A key is a code
/// followed by its index.
inline std::int64_t split_at_highest_differing_bit(Codes codes, std::int64_t first, std::int64_t last)
{
    const auto halves = [&](const auto& bits_of) {
        const auto highest = std::bit_floor(bits_of(first) ^ bits_of(last));
        std::int64_t gamma = first;
        while ((bits_of(gamma + 1) & highest) == 0) ++gamma;
        return gamma;
    };
    if (codes[static_cast<std::size_t>(first)] != codes[static_cast<std::size_t>(last)])
        return halves([&](std::int64_t i) { return codes[static_cast<std::size_t>(i)]; });
    return halves([](std::int64_t i) { return static_cast<std::uint64_t>(i); });
}

/// Makes `node` the root of the tree over keys first to last.
inline void lauterbach_subtree(Codes codes, std::vector<Node>& nodes, std::uint32_t node,
                               std::int64_t first, std::int64_t last)
{
    if (first == last) return;
    const std::int64_t gamma = split_at_highest_differing_bit(codes, first, last);
    const std::uint32_t left = radix_child(first, gamma, gamma, codes.size());
    const std::uint32_t right = radix_child(gamma + 1, last, gamma + 1, codes.size());
    nodes[node].children = {left, right};
    nodes[left].parent = node;
    nodes[right].parent = node;
    lauterbach_subtree(codes, nodes, left, first, gamma);
    lauterbach_subtree(codes, nodes, right, gamma + 1, last);
}

/// The same nodes that radix_tree returns for these codes.
inline std::vector<Node> lauterbach_tree(Codes codes)
{
    if (codes.empty()) return {};
    std::vector<Node> nodes(2 * codes.size() - 1);
    lauterbach_subtree(codes, nodes, 0, 0, std::ssize(codes) - 1);
    return nodes;
}

} // namespace ref
