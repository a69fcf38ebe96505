#pragma once

// Computes boxes from the leaves up to the root [Karras 2012, sec. 4; the counting follows Apetrei
// 2014].

#include "cuda/parallel/atomic.h"
#include "cuda/trees/node.h"

#include <cstdint>
#include <span>

namespace fast {

/// Kernel over leaves: walks from a leaf towards the root and writes, at every node, the box of the
/// child that it comes from. Of the two walks that arrive at a node the first stops there; the second
/// finds both boxes written and continues with their union.
///
/// `arrive_at` is a parameter so that tests can show the effect of a wrong one.
template <std::uint32_t (*arrive_at)(std::uint32_t&) = arrive>
struct RefitBounds {
    std::span<const Aabb> boxes;
    std::span<const std::uint32_t> primitives; // one per leaf
    std::span<const std::uint32_t> leaf_links;
    std::span<Node> nodes;

    HD void operator()(std::uint32_t leaf) const
    {
        Aabb box = boxes[primitives[leaf]];
        for (std::uint32_t link = leaf_links[leaf]; link != no_node;) {
            Node& node = nodes[link >> 1];
            node.bounds[link & 1] = box;
            // Releases the box just written, and acquires the sibling's if the sibling arrived first.
            // Without this order the union below could read a box before it is written.
            if (arrive_at(node.arrivals) == 0) return;
            node.arrivals = 0; // no other walk comes here: ready for the next refit
            box = unite(node.bounds[0], node.bounds[1]); // map: refit
            link = node.link;
        }
    }
};

} // namespace fast
