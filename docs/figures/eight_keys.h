#pragma once

// The example of docs/tree-by-hand.md: eight keys, the tree over them, and the searches that found it.

#include "explain/tree.h"
#include "ref/trees/bvh.h"
#include "ref/trees/radix_tree.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace figures {

constexpr int bits_per_axis = 10;
constexpr int code_bits = 3 * bits_per_axis;

/// A delta of ref/trees/radix_tree.h, which counts in words of 64 bits, without the bits above the code.
/// -1 stays: there is no such key.
constexpr int of_code(int delta)
{
    return delta < 0 ? delta : delta - (64 - code_bits);
}

/// A radix tree with everything that the page shows of it.
struct EightKeys {
    std::vector<ref::Aabb> boxes; // of the primitives, in the order of the file
    ref::Tree tree;
    std::vector<std::uint64_t> codes;          // sorted
    std::vector<explain::NodeSearch> searches; // of each internal node
    std::vector<int> depth;                    // of each node; 0 for the root
    int shown_bits = 1; // the leading bits of a code that distinguish all that differ

    explicit EightKeys(std::vector<ref::Aabb> of) : boxes(std::move(of))
    {
        tree = ref::build(boxes, ref::Builder::morton30);
        const std::vector<std::uint64_t> unsorted = ref::morton_codes(boxes, bits_per_axis);
        for (const std::uint32_t primitive : tree.primitives) codes.push_back(unsorted[primitive]);
        for (std::uint32_t i = 0; i < tree.internal_count(); ++i)
            searches.push_back(explain::search_of_node(codes, i));
        depth.resize(tree.nodes.size(), 0);
        for (std::uint32_t node = 0; node < tree.nodes.size(); ++node)
            for (std::uint32_t at = tree.nodes[node].parent; at != ref::no_node;
                 at = tree.nodes[at].parent)
                ++depth[node];
        for (std::size_t i = 1; i < codes.size(); ++i)
            if (codes[i - 1] != codes[i]) shown_bits = std::max(shown_bits, common(i - 1, i) + 1);
    }
    [[nodiscard]] std::size_t size() const { return codes.size(); }
    [[nodiscard]] int deepest() const { return *std::ranges::max_element(depth); }
    /// delta of keys i and j.
    [[nodiscard]] int common(std::size_t i, std::size_t j) const
    {
        return of_code(ref::delta(codes, static_cast<std::int64_t>(i), static_cast<std::int64_t>(j)));
    }
    /// The leading bits of key i.
    [[nodiscard]] std::string bits(std::size_t i) const
    {
        std::string text;
        for (int bit = 0; bit < shown_bits; ++bit)
            text += (codes[i] >> (code_bits - 1 - bit) & 1) != 0 ? '1' : '0';
        return text;
    }
    /// The last three bits of the index i < 8: what distinguishes the indices of eight keys.
    [[nodiscard]] static std::string index_bits(std::size_t i)
    {
        return {static_cast<char>('0' + (i >> 2 & 1)), static_cast<char>('0' + (i >> 1 & 1)),
                static_cast<char>('0' + (i & 1))};
    }
};

} // namespace figures
