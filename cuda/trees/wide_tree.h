#pragma once

// From a tree of two children per node to one of four, with groups of up to four triangles for leaves.
//
// A node says which nodes below it are its children when it is a wide one (wide_node.h: opened); whether
// it is one at all is known only from above. So wide nodes are found level by level from the root on. In
// which order they are found is left to chance; their numbers are not: they follow those of the narrow
// nodes, so that every executor makes the same tree, and neighbours in space stay neighbours in memory.

#include "cuda/parallel/atomic.h"
#include "cuda/parallel/buffer.h"
#include "cuda/parallel/executor.h"
#include "cuda/parallel/radix_sort.h"
#include "cuda/trees/triangle_group.h"
#include "cuda/trees/wide_node.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace gpu {

/// What rays need of a wide tree. Without nodes group 0, if there is one, is all.
struct WideTreeView {
    std::span<const WideNode> nodes;
    std::span<const TriangleGroup> groups;
    Box bounds; // of the root
};

/// What becomes of a node or leaf of the narrow tree: words that sort as they are to be numbered.
constexpr std::uint32_t becomes_wide_node = 0;
constexpr std::uint32_t becomes_group = 1;
constexpr std::uint32_t becomes_nothing = 2;

/// Nodes and leaves numbered through along the curve: leaf l is 2 l, inner node i, of whose range i is
/// one end, 2 i + 1. So groups that lie side by side are stored side by side.
HD constexpr std::uint32_t number_of(std::uint32_t child)
{
    return is_leaf(child) ? child << 1 : child << 1 | 1;
}

/// The inverse.
HD constexpr std::uint32_t child_of(std::uint32_t number)
{
    return (number & 1) != 0 ? number >> 1 : number >> 1 | leaf_bit;
}

/// Kernel over nodes and leaves: none has become anything yet, but the root.
struct BeginWideTree {
    std::uint32_t root; // its number
    std::uint32_t root_becomes;
    std::span<std::uint32_t> fates;
    std::span<std::uint32_t> numbers;
    std::span<std::uint32_t> found;  // wide nodes, in the order in which they are found
    std::span<std::uint32_t> counts; // of wide nodes, of groups

    HD void operator()(std::uint32_t i) const
    {
        fates[i] = i == root ? root_becomes : becomes_nothing;
        numbers[i] = i;
        if (i != root) return;
        if (!found.empty()) found[0] = 0;
        counts[0] = root_becomes == becomes_wide_node ? 1 : 0;
        counts[1] = root_becomes == becomes_group ? 1 : 0;
    }
};

/// Kernel over the wide nodes of one level: finds those of the next.
struct FindWideNodes {
    std::span<const Node> nodes;
    std::uint32_t first; // of this level in `found`
    std::span<std::uint32_t> fates;
    std::span<std::uint32_t> found;
    std::span<std::uint32_t> counts;

    HD void operator()(std::uint32_t i) const
    {
        const OpenedNode node = opened(nodes, found[first + i]);
        for (int c = 0; c < node.count; ++c) {
            const std::uint32_t child = node.children[c];
            const bool group = node.groups[c];
            fates[number_of(child)] = group ? becomes_group : becomes_wide_node;
            const std::uint32_t place = arrive(counts[group ? 1 : 0]);
            if (!group) found[place] = child;
        }
    }
};

/// Kernel over all that has become something, wide nodes first: its new name.
struct NameWideNodes {
    std::span<const std::uint32_t> numbers;
    std::uint32_t wide_nodes;
    std::span<std::uint32_t> names;

    HD void operator()(std::uint32_t i) const
    {
        names[numbers[i]] = i < wide_nodes ? i : (i - wide_nodes) | leaf_bit;
    }
};

/// Kernel over wide nodes.
struct FillWideNodes {
    std::span<const Node> nodes;
    std::span<const std::uint32_t> numbers;
    std::span<const std::uint32_t> names;
    std::span<WideNode> wide;

    HD void operator()(std::uint32_t i) const
    {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        const OpenedNode node = opened(nodes, child_of(numbers[i]));
        for (int c = 0; c < 4; ++c) {
            const bool there = c < node.count;
            wide[i].children[c] = there ? names[number_of(node.children[c])] : no_node;
            for (int axis = 0; axis < 3; ++axis) {
                wide[i].planes[axis][c] = there ? node.boxes[c].lower[axis] : infinity;
                wide[i].planes[3 + axis][c] = there ? node.boxes[c].upper[axis] : -infinity;
            }
        }
    }
};

/// Kernel over groups. A primitive that is no triangle has a number, but no vertices.
struct FillGroups {
    std::span<const Node> nodes;
    std::span<const std::uint32_t> numbers;
    std::span<const std::uint32_t> primitives; // by leaf
    std::span<const Triangle> triangles;       // by primitive
    std::span<TriangleGroup> groups;

    HD void operator()(std::uint32_t i) const
    {
        std::uint32_t leaves[most_in_group];
        const std::uint32_t count = leaves_below(nodes, child_of(numbers[i]), leaves);
        for (std::uint32_t lane = 0; lane < most_in_group; ++lane) {
            const std::uint32_t primitive = lane < count ? primitives[leaves[lane]] : no_primitive;
            groups[i].primitives[lane] = primitive;
            for (int k = 0; k < 3; ++k)
                for (int axis = 0; axis < 3; ++axis)
                    groups[i].vertices[k][axis][static_cast<int>(lane)] =
                        primitive < triangles.size() ? triangles[primitive].vertices[k][axis]
                                                     : std::numeric_limits<float>::quiet_NaN();
        }
    }
};

/// Owns a wide tree.
class WideTree {
public:
    /// Of a tree (node.h) whose leaves hold `primitives`, of which the first are `triangles`; all in
    /// `memory`, which is that of the kernels of `executor`. Waits for every level. Throws OutOfMemory.
    template <Executor E>
    WideTree(Memory& memory, E& executor, std::span<const Node> nodes,
             std::span<const std::uint32_t> primitives, std::span<const Triangle> triangles)
        : nodes_(memory, 0), groups_(memory, 0)
    {
        if (primitives.empty()) return;
        const auto all = static_cast<std::uint32_t>(nodes.size() + primitives.size());
        std::array<Buffer<std::uint32_t>, 2> fates{Buffer<std::uint32_t>(memory, all),
                                                   Buffer<std::uint32_t>(memory, all)};
        std::array<Buffer<std::uint32_t>, 2> numbers{Buffer<std::uint32_t>(memory, all),
                                                     Buffer<std::uint32_t>(memory, all)};
        Buffer<std::uint32_t> found(memory, nodes.size());
        Buffer<std::uint32_t> counts(memory, 2);
        executor(all,
                 BeginWideTree{number_of(nodes.empty() ? leaf_bit : 0),
                               primitives.size() > most_in_group ? becomes_wide_node : becomes_group,
                               fates[0].all(), numbers[0].all(), found.all(), counts.all()});
        std::uint32_t wide_nodes = 0;
        for (std::uint32_t next = counts.read(1)[0]; next > wide_nodes; next = counts.read(1)[0]) {
            executor(next - wide_nodes,
                     FindWideNodes{nodes, wide_nodes, fates[0].all(), found.all(), counts.all()});
            wide_nodes = next;
        }
        const std::uint32_t groups = counts.read(2)[1];

        Alternating<std::uint32_t> fate{fates[0].all(), fates[1].all()};
        Alternating<std::uint32_t> number{numbers[0].all(), numbers[1].all()};
        Buffer<std::uint32_t> scratch(memory,
                                      sort_scratch<std::uint32_t, std::uint32_t>(executor, all, 2));
        radix_sort(executor, fate, number, 2, scratch.all());

        const std::span<std::uint32_t> names = number.other;
        executor(wide_nodes + groups, NameWideNodes{number.current, wide_nodes, names});
        nodes_ = Buffer<WideNode>(memory, wide_nodes);
        groups_ = Buffer<TriangleGroup>(memory, groups);
        executor(wide_nodes, FillWideNodes{nodes, number.current, names, nodes_.all()});
        executor(groups, FillGroups{nodes, number.current.subspan(wide_nodes), primitives, triangles,
                                    groups_.all()});
        if (nodes.empty()) return;
        Node root{};
        memory.read(&root, nodes.data(), sizeof root);
        bounds_ = unite(root.bounds[0], root.bounds[1]);
    }

    /// Stays good while the tree lives.
    [[nodiscard]] WideTreeView view() const { return {nodes_.all(), groups_.all(), bounds_}; }

private:
    Buffer<WideNode> nodes_;
    Buffer<TriangleGroup> groups_;
    Box bounds_ = empty_box();
};

} // namespace gpu
