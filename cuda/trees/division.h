#pragma once

// How a binary tree is best collapsed into one whose nodes have up to eight children [Ylitie, Karras,
// Laine 2017, sec. 3.1].
//
// The subtree below a node may be divided into several subtrees, so that as many children of an ancestor
// stand for it. Let C(n, i) be the smallest cost of the subtree of node n, divided into at most i
// subtrees. A division gives k of i parts to the left child l, and the others to the right child r. If a
// single part is a wide node, it has the area A(n), and its children are a division of the same subtree:
//
//   C(n, 1) = A(n) + D(n, most_children)
//   C(n, i) = min(D(n, i), C(n, 1))  for i > 1,  where D(n, i) = min over k of C(l, k) + C(r, i - k)
//
// The paper takes C(n, i - 1) in place of C(n, 1). That is the same: D(n, i) does not grow with i.
// The cost is the sum of the areas of all wide nodes: by the surface area heuristic, the number of
// nodes that a ray visits. A subtree of at most most_in_group leaves is a group, whatever its ancestors
// are. So groups add the same to the cost of all collapsed trees, and count as 0.

#include "cuda/parallel/atomic.h"
#include "cuda/parallel/buffer.h"
#include "cuda/parallel/executor.h"
#include "cuda/parallel/lanes.h"
#include "cuda/trees/wide_node.h"

#include <cstdint>
#include <limits>
#include <span>

namespace fast {

/// Lane i - 1 holds C(n, i) of a node n, for i below most_children: the sibling needs a part, too. Of a
/// group: all are 0.
using DivisionCosts = Lanes;

/// The best divisions of the subtree below a binary node. They are stored apart from their costs: this
/// is what the collapse reads, and so all of it stays in a cache.
struct Division {
    /// Of a group: the number of its leaves. Otherwise 0 and, from bit 4 on, four bits for each i from 2
    /// to most_children: three for k of D(n, i), one that says whether C(n, i) is D(n, i).
    std::uint32_t packed;

    [[nodiscard]] HD std::uint32_t leaves_of_group() const { return packed & 15; } // 0: is no group
    [[nodiscard]] HD bool is_group() const { return leaves_of_group() != 0; }
    /// How many of i parts the left child gets in D(n, i).
    [[nodiscard]] HD int to_left(int parts) const { return static_cast<int>(bits_of(parts) & 7); }
    /// Whether the subtree, of at most i parts, is best divided into i parts, and not whole.
    [[nodiscard]] HD bool divided(int parts) const { return (bits_of(parts) & 8) != 0; }

private:
    [[nodiscard]] HD std::uint32_t bits_of(int parts) const { return packed >> (4 * (parts - 1)) & 15; }
};
static_assert(most_children == 8 && most_in_group < 16);

/// The divisions of all nodes of a tree, and their costs.
struct DivisionsView {
    std::span<DivisionCosts> costs;
    std::span<Division> of; // by node

    /// Of node `number` with this box, from those of its children.
    HD void divide(std::uint32_t number, std::uint32_t left_child, std::uint32_t right_child,
                   const Aabb& box) const
    {
        const std::uint32_t left_leaves = leaves_of_group(left_child);
        const std::uint32_t right_leaves = leaves_of_group(right_child);
        if (left_leaves != 0 && right_leaves != 0 && left_leaves + right_leaves <= most_in_group) {
            of[number] = {left_leaves + right_leaves};
            return;
        }
        const DivisionCosts left = costs_of(left_child, left_leaves);
        const DivisionCosts right = costs_of(right_child, right_leaves);
        // In lane i - 2: the best k so far, and the cost with it. Where k is not below i, the cost of
        // the right child is read from before its first: infinity.
        constexpr float infinity = std::numeric_limits<float>::infinity();
        float shifted[2 * lane_count];
        store_lanes(all_lanes(infinity), shifted);
        store_lanes(right, shifted + lane_count);
        Lanes best = all_lanes(1.0f);
        Lanes least = all_lanes(left[0]) + right;
        for (int k = 2; k < most_children; ++k) {
            const Lanes cost = all_lanes(left[k - 1]) + load_lanes(shifted + lane_count - (k - 1));
            best = where_below(cost, least, all_lanes(static_cast<float>(k)), best);
            least = smaller(cost, least);
        }
        // An area that overflows may be NaN (0 * infinity): then all divisions are as good. Without any
        // area, the fewest nodes are best.
        const float area = half_area(box);
        constexpr float least_area = std::numeric_limits<float>::min();
        const float own = area >= 0 ? (area > least_area ? area : least_area) : infinity;
        const float whole = own + least[most_children - 2]; // C(n, 1)
        float parts[lane_count];                            // k of D(n, i)
        store_lanes(best, parts);
        const LaneBits divided = not_above(least, all_lanes(whole)); // D(n, i) <= C(n, 1)
        std::uint32_t packed = 0;
        for (int i = 2; i <= most_children; ++i)
            packed |= (static_cast<std::uint32_t>(parts[i - 2]) | (divided >> (i - 2) & 1) << 3)
                      << (4 * (i - 1));
        float result[1 + lane_count] = {whole};
        store_lanes(smaller(least, all_lanes(whole)), result + 1);
        costs[number] = load_lanes(result);
        of[number] = {packed};
    }

private:
    [[nodiscard]] HD std::uint32_t leaves_of_group(std::uint32_t child) const
    {
        // Which children are leaves cannot be predicted: a choice of an address instead of a branch.
        const Division leaf{1};
        return (is_leaf(child) ? &leaf : of.data() + child)->leaves_of_group();
    }
    [[nodiscard]] HD DivisionCosts costs_of(std::uint32_t child, std::uint32_t leaves) const
    {
        return leaves != 0 ? all_lanes(0.0f) : costs[child];
    }
};

/// Kernel over leaves: divides all nodes of a tree, from the leaves up, as in the refit (refit.h).
struct DivideNodes {
    std::span<Node> nodes; // their arrivals are counted, and are 0 again afterwards
    std::span<const std::uint32_t> leaf_links;
    DivisionsView divisions;

    HD void operator()(std::uint32_t leaf) const
    {
        for (std::uint32_t link = leaf_links[leaf]; link != no_node; link = nodes[link >> 1].link) {
            Node& node = nodes[link >> 1];
            if (arrive(node.arrivals) == 0) return;
            node.arrivals = 0;
            divisions.divide(link >> 1, node.children[0], node.children[1],
                             unite(node.bounds[0], node.bounds[1]));
        }
    }
};

/// Owns the divisions of a tree.
class Divisions {
public:
    /// Undefined; for up to `capacity` nodes. Throws OutOfMemory.
    Divisions(Memory& memory, std::size_t capacity)
        : costs_(memory, capacity), divisions_(memory, capacity)
    {}
    /// Of a tree (node.h) with these links of its leaves, in the memory of the kernels of `executor`.
    template <Executor E>
    Divisions(Memory& memory, E& executor, std::span<Node> nodes,
              std::span<const std::uint32_t> leaf_links)
        : Divisions(memory, nodes.size())
    {
        executor(static_cast<std::uint32_t>(leaf_links.size()), DivideNodes{nodes, leaf_links, view()});
    }
    [[nodiscard]] DivisionsView view() { return {costs_.all(), divisions_.all()}; }
    [[nodiscard]] std::span<const Division> all() const { return divisions_.all(); }

private:
    Buffer<DivisionCosts> costs_;
    Buffer<Division> divisions_;
};

} // namespace fast
