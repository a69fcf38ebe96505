#pragma once

// How a binary tree is best collapsed into one whose nodes have up to eight children [Ylitie, Karras,
// Laine 2017, sec. 3.1].
//
// The subtree below a node may be divided into several subtrees, so that as many children of an ancestor
// stand for it. Let C(n, i) be the smallest cost of the subtree of node n, divided into at most i
// subtrees. A division gives k of i parts to the left child l, and the others to the right child r. If a
// single part is a wide node, it has the area A(n), and its children are a division of the same subtree:
//
//   C(n, i) = min(D(n, i), C(n, i - 1))  for i > 1,  where D(n, i) = min over k of C(l, k) + C(r, i - k)
//   C(n, 1) = A(n) + D(n, most_children)
//
// The cost is the sum of the areas of all wide nodes: by the surface area heuristic, the number of
// nodes that a ray visits. A subtree of at most most_in_group leaves is a group, whatever its ancestors
// are. So groups add the same to the cost of all collapsed trees, and count as 0.

#include "cuda/parallel/atomic.h"
#include "cuda/trees/wide_node.h"

#include <cstdint>
#include <limits>
#include <span>

namespace fast {

/// The best divisions of the subtree below a binary node.
struct Division {
    static constexpr int most_parts = most_children - 1; // of a child: its sibling needs a part, too

    float costs[most_parts]; // C(n, 1), C(n, 2), ...; of a group undefined
    /// Of a group: the number of its leaves. Otherwise 0 and, from bit 4 on, four bits for each i from 2
    /// to most_children: three for k of D(n, i), one that says whether C(n, i) is C(n, i - 1).
    std::uint32_t packed;

    [[nodiscard]] HD std::uint32_t leaves_of_group() const { return packed & 15; } // 0: is no group
    [[nodiscard]] HD bool is_group() const { return leaves_of_group() != 0; }
    /// How many of i parts the left child gets in D(n, i).
    [[nodiscard]] HD int to_left(int parts) const { return static_cast<int>(bits_of(parts) & 7); }
    /// Of at most `parts`, so many are best.
    [[nodiscard]] HD int best(int parts) const
    {
        while (parts > 1 && (bits_of(parts) & 8) != 0) --parts;
        return parts;
    }

private:
    [[nodiscard]] HD std::uint32_t bits_of(int parts) const { return packed >> (4 * (parts - 1)) & 15; }
};
static_assert(sizeof(Division) == 32 && most_children == 8 && most_in_group < 16);

/// Kernel over leaves: divides all nodes, from the leaves up, as in the refit (refit.h).
struct DivideNodes {
    std::span<const Node> nodes;
    std::span<const std::uint32_t> leaf_links;
    std::span<std::uint32_t> arrivals; // at each node; 0 at first
    std::span<Division> divisions;

    HD void operator()(std::uint32_t leaf) const
    {
        for (std::uint32_t link = leaf_links[leaf]; link != no_node; link = nodes[link >> 1].link) {
            if (arrive(arrivals[link >> 1]) == 0) return;
            divisions[link >> 1] = divided(nodes[link >> 1]);
        }
    }

private:
    [[nodiscard]] HD std::uint32_t leaves_of_group(std::uint32_t child) const
    {
        return is_leaf(child) ? 1 : divisions[child].leaves_of_group();
    }
    /// C(child, 1), C(child, 2), ...
    HD void read_costs(std::uint32_t child, float (&costs)[Division::most_parts]) const
    {
        const bool group = leaves_of_group(child) != 0;
        for (int i = 0; i < Division::most_parts; ++i)
            costs[i] = group ? 0.0f : divisions[child].costs[i];
    }
    [[nodiscard]] HD Division divided(const Node& node) const
    {
        Division result{};
        const std::uint32_t left_leaves = leaves_of_group(node.children[0]);
        const std::uint32_t right_leaves = leaves_of_group(node.children[1]);
        if (left_leaves != 0 && right_leaves != 0 && left_leaves + right_leaves <= most_in_group) {
            result.packed = left_leaves + right_leaves;
            return result;
        }
        float left[Division::most_parts];
        float right[Division::most_parts];
        read_costs(node.children[0], left);
        read_costs(node.children[1], right);
        float divided[most_children + 1]; // D(n, i)
        for (int i = 2; i <= most_children; ++i) {
            int best = 1; // k
            float least = left[0] + right[i - 2];
            for (int k = 2; k < i; ++k) {
                const float cost = left[k - 1] + right[i - k - 1];
                if (cost < least) {
                    least = cost;
                    best = k;
                }
            }
            divided[i] = least;
            result.packed |= static_cast<std::uint32_t>(best) << (4 * (i - 1));
        }
        // An area that overflows may be NaN (0 * infinity): then all divisions are as good.
        const float area = half_area(unite(node.bounds[0], node.bounds[1]));
        result.costs[0] =
            (area >= 0 ? area : std::numeric_limits<float>::infinity()) + divided[most_children];
        for (int i = 2; i <= most_children; ++i) {
            const bool fewer = !(divided[i] < result.costs[i - 2]);
            if (fewer) result.packed |= 8u << (4 * (i - 1));
            if (i <= Division::most_parts)
                result.costs[i - 1] = fewer ? result.costs[i - 2] : divided[i];
        }
        return result;
    }
};

/// The children of a wide node.
struct OpenedNode {
    Aabb boxes[most_children];
    std::uint32_t children[most_children];
    bool groups[most_children]; // which of the children are
    int count;
};

/// The children of a wide node: the best division of the subtree below `node`, which is no group, from
/// left to right.
HD inline OpenedNode opened(std::span<const Node> nodes, std::span<const Division> divisions,
                            std::uint32_t node)
{
    struct Part {
        std::uint32_t parent;
        int side;
        int parts; // into which this child may be divided
    };
    Part stack[most_children]; // each stands for one child at least
    int height = 0;
    const auto divide = [&](std::uint32_t at, int parts) {
        const int to_left = divisions[at].to_left(parts);
        stack[height++] = {at, 1, parts - to_left};
        stack[height++] = {at, 0, to_left};
    };
    OpenedNode result{};
    divide(node, most_children);
    while (height > 0) {
        const Part part = stack[--height];
        const std::uint32_t child = nodes[part.parent].children[part.side];
        const bool group = is_leaf(child) || divisions[child].is_group();
        const int parts = group ? 1 : divisions[child].best(part.parts);
        if (parts > 1) {
            divide(child, parts);
            continue;
        }
        result.boxes[result.count] = nodes[part.parent].bounds[part.side];
        result.children[result.count] = child;
        result.groups[result.count++] = group;
    }
    return result;
}

} // namespace fast
