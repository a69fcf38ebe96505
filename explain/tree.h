#pragma once

// One primitive in a radix tree: its code, the binary searches of Karras' construction step by step, and
// the way to the root in the refit. The searches are those of ref/trees/radix_tree.h, with a record of
// each step; the tree is the reference's own.

#include "ref/trees/aabb.h"
#include "ref/trees/morton.h"
#include "ref/trees/tree.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace explain {

/// One question of a binary search: is delta(i, key) above the bound?
struct Probe {
    std::int64_t step; // l_max, t of the length, or t of the split
    std::int64_t key;  // may be outside 0 ... n - 1: delta is -1 there
    int delta;
    bool longer; // above the bound: the search takes the step
};

/// How internal node i finds its keys, with the names of [Karras 2012, fig. 4].
struct NodeSearch {
    std::int64_t i;
    int delta_right, delta_left; // to keys i + 1 and i - 1
    int d;
    int delta_min;               // the bound of the first two searches
    std::vector<Probe> doubling; // of l_max
    std::vector<Probe> length;   // of l
    std::int64_t l, j;
    int delta_node;           // the bound of the third search
    std::vector<Probe> split; // of s
    std::int64_t s, gamma;
};

/// A key of the sorted order.
struct Key {
    std::int64_t place;
    std::uint32_t primitive;
    std::uint64_t code;
    int delta; // with the key of the explained primitive; of that key itself: 64 + 32
};

/// An internal node on the way from the leaf to the root, and the two walks of the refit that arrive.
struct Ancestor {
    std::uint32_t node;
    std::int64_t first, last, gamma;     // its keys, and the last one of its left child
    std::array<std::int64_t, 2> arrives; // the leaves that the walks come from, in order
    std::array<std::uint32_t, 2> from;   // the children that they come from
    ref::Aabb bounds;
};

/// The two walks of a refit that arrive at an internal node: the leaves that they come from, and the
/// children that they come through.
struct Arrivals {
    std::array<std::int64_t, 2> leaves;
    std::array<std::uint32_t, 2> children;
};

struct TreeExplanation {
    std::uint32_t primitive;
    int bits_per_axis;
    std::uint32_t primitives; // of the tree
    ref::Vec3 centroid;
    ref::Aabb box;  // of the primitive
    ref::Aabb grid; // that the centroids span
    ref::Cell cell;
    Key key;
    std::optional<Key> left, right; // the neighbours in the sorted order
    std::optional<NodeSearch>
        search;                // of the internal node with the key's number; none for the last key
    std::uint32_t leaf;        // its node
    std::vector<Ancestor> way; // from the leaf's parent to the root
};

/// The searches of internal node i of the tree over sorted codes, 0 <= i < codes.size() - 1.
NodeSearch search_of_node(std::span<const std::uint64_t> codes, std::int64_t i);

/// The arrivals at each internal node if the refit starts its walks in `leaf_order`, a permutation of
/// the leaves, as ref::refit does.
std::vector<Arrivals> refit_arrivals(const ref::Tree& tree, std::span<const std::uint32_t> leaf_order);

/// The primitive number `primitive` in the radix tree over the boxes, with codes of 10 or 21 bits per
/// axis. The refit starts its walks at the leaves from left to right, as ref::refit does. Throws
/// std::invalid_argument for a primitive that does not exist, and the errors of ref::build.
TreeExplanation explain_tree(std::span<const ref::Aabb> boxes, int bits_per_axis,
                             std::uint32_t primitive);

} // namespace explain
