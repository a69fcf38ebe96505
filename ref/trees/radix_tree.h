#pragma once

// The binary radix tree over sorted keys; every node is computed independently of the others [Karras
// 2012].
//
// Names follow the paper: delta (length of the longest common prefix), d (direction of the range), l
// (its length), s (distance of the split), gamma (its position), i and j (ends of the range). A key is
// a code followed by its index. The index breaks ties below every bit of the code, so that all keys
// differ and the tree is unique.

#include "ref/trees/tree.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

namespace ref {

using Codes = std::span<const std::uint64_t>;

/// Length of the longest common prefix of keys i and j; -1 if there is no key j [Karras 2012, sec. 3].
inline int delta(Codes codes, std::int64_t i, std::int64_t j)
{
    if (j < 0 || j >= std::ssize(codes)) return -1;
    const std::uint64_t a = codes[static_cast<std::size_t>(i)];
    const std::uint64_t b = codes[static_cast<std::size_t>(j)];
    if (a != b) return std::countl_zero(a ^ b); // map: delta
    // The tie-break must be the same in every call [Karras 2012, sec. 4]. A single comparison without
    // it gives one node two parents and leaves another without any.
    // map: delta-ties
    return 64 + std::countl_zero(static_cast<std::uint32_t>(i) ^ static_cast<std::uint32_t>(j));
}

/// The range of keys, first to last, that a node covers, and gamma, the last key of its left child.
struct RadixNode {
    std::int64_t first, last, gamma;
};

/// Internal node i < n - 1 of the tree over n sorted codes [Karras 2012, fig. 4].
inline RadixNode radix_node(Codes codes, std::int64_t i)
{
    // The range extends from i towards the neighbour with the longer common prefix. The other
    // neighbour belongs to a sibling; its delta is a strict lower bound on the prefix that the keys of
    // this node share.
    const int d = delta(codes, i, i + 1) > delta(codes, i, i - 1) ? 1 : -1; // map: range-direction
    const int delta_min = delta(codes, i, i - d);

    // The length of the range: double l_max until it is beyond the end, then find the bits of l from
    // the highest.
    std::int64_t l_max = 2;
    while (delta(codes, i, i + l_max * d) > delta_min) l_max *= 2;
    std::int64_t l = 0;
    for (std::int64_t t = l_max / 2; t >= 1; t /= 2)
        if (delta(codes, i, i + (l + t) * d) > delta_min) l += t; // map: range-length
    const std::int64_t j = i + l * d;

    // The split: the farthest key whose common prefix with key i is longer than that of key j.
    const int delta_node = delta(codes, i, j);
    std::int64_t s = 0;
    std::int64_t t = l;
    do {
        t = (t + 1) / 2;                                           // rounded up: l / 2, l / 4, ..., 1
        if (delta(codes, i, i + (s + t) * d) > delta_node) s += t; // map: split
    } while (t > 1);
    const std::int64_t gamma = i + s * d + std::min(d, 0);
    return {std::min(i, j), std::max(i, j), gamma};
}

/// The node number of the child that covers keys first to last: a leaf, or the internal node whose
/// number is the end of the range next to its parent's split [Karras 2012, sec. 3].
inline std::uint32_t radix_child(std::int64_t first, std::int64_t last, std::int64_t at_split,
                                 std::size_t n)
{
    const auto leaves_begin = static_cast<std::int64_t>(n) - 1;
    return static_cast<std::uint32_t>(first == last ? leaves_begin + first : at_split);
}

/// The nodes (children and parents) of the tree over `codes`, which must be sorted. There are 2 n - 1
/// nodes, numbered as in tree.h, and 0 for n = 0. The depth is at most code bits + ceil(log2 n).
inline std::vector<Node> radix_tree(Codes codes)
{
    const std::size_t n = codes.size();
    if (n == 0) return {};
    std::vector<Node> nodes(2 * n - 1);
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
        const auto [first, last, gamma] = radix_node(codes, i);
        nodes[i].children = {radix_child(first, gamma, gamma, n), // map: children
                             radix_child(gamma + 1, last, gamma + 1, n)};
        for (const std::uint32_t child : nodes[i].children) nodes[child].parent = i;
    }
    return nodes;
}

} // namespace ref
