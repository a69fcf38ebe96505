#pragma once

// A tree of up to eight children per node, whose leaves are groups of up to most_in_group triangles
// [Wald, Benthin, Boulos 2008]: a binary tree, collapsed (collapse.h).

#include "cuda/parallel/buffer.h"
#include "cuda/parallel/executor.h"
#include "cuda/parallel/sorted_pairs.h"
#include "cuda/trees/collapse.h"

#include <bit>
#include <cstdint>
#include <span>

namespace fast {

/// A wide tree as traversal reads it. Without nodes the tree is group 0, if there is one.
struct WideTreeView {
    std::span<const WideNode> nodes;
    std::span<const TriangleGroup> groups;
    Aabb bounds; // of the root
};

/// Builds and owns a wide tree.
class WideTree {
public:
    /// Of a tree (node.h) with these divisions, whose leaves hold `primitives`, of which the first are
    /// `triangles`; all in `memory`, which is that of the kernels of `executor`. Waits for every level.
    /// Throws OutOfMemory.
    template <Executor E>
    WideTree(Memory& memory, E& executor, std::span<const Node> nodes,
             std::span<const Division> divisions, std::span<const std::uint32_t> primitives,
             std::span<const Triangle> triangles)
        : nodes_(memory, 0), groups_(memory, 0)
    {
        if (primitives.empty()) return;
        const auto leaves = static_cast<std::uint32_t>(primitives.size());
        // A wide node stands for at least one binary node, and a group for at least one leaf. Mostly
        // there are far fewer, and on a host the memory that stays unused costs nothing.
        const auto bits = static_cast<int>(std::bit_width(2 * leaves - 1)); // of a number (number_of)
        SortedPairs<std::uint32_t> wide(memory, executor, static_cast<std::uint32_t>(nodes.size()),
                                        bits);
        SortedPairs<std::uint32_t> group(memory, executor, leaves, bits);
        Buffer<std::uint32_t> places(memory, nodes.size());
        Buffer<OpenedNode> opened_nodes(memory, nodes.size());
        Buffer<std::uint32_t> counts(memory, 2);
        const FoundNodes found{.counts = counts.all(),
                               .numbers = wide.keys(),
                               .order = wide.values(),
                               .places = places.all(),
                               .opened = opened_nodes.all(),
                               .group_numbers = group.keys(),
                               .group_places = group.values()};
        executor(1, FindRoot{leaves, found});
        std::uint32_t wide_nodes = 0;
        for (std::uint32_t next = counts.read(1)[0]; next > wide_nodes; next = counts.read(1)[0]) {
            executor(next - wide_nodes, FindWideNodes{nodes, divisions, wide_nodes, found});
            wide_nodes = next;
            ++levels_;
        }
        const std::uint32_t groups = counts.read(2)[1];
        wide.sort(executor, wide_nodes);
        group.sort(executor, groups);

        Buffer<std::uint32_t> ranks(memory, wide_nodes);
        nodes_ = Buffer<WideNode>(memory, wide_nodes);
        groups_ = Buffer<TriangleGroup>(memory, groups);
        executor(wide_nodes, RankWideNodes{wide.sorted_values(), ranks.all()});
        executor(wide_nodes,
                 FillWideNodes{nodes, found, wide.sorted_values(), ranks.all(), nodes_.all()});
        executor(groups, BeginGroups{nodes, group.sorted_keys(), group.sorted_values(), primitives,
                                     ranks.all(), nodes_.all(), groups_.all()});
        executor(groups, FillGroups{triangles, groups_.all()});
        if (nodes.empty()) return;
        Node root{};
        memory.read(&root, nodes.data(), sizeof root);
        bounds_ = unite(root.bounds[0], root.bounds[1]);
    }

    /// Of nodes; a traversal needs space for them (traversal_stack.h).
    [[nodiscard]] int levels() const { return levels_; }
    /// Stays good while the tree lives.
    [[nodiscard]] WideTreeView view() const { return {nodes_.all(), groups_.all(), bounds_}; }

private:
    Buffer<WideNode> nodes_;
    Buffer<TriangleGroup> groups_;
    Aabb bounds_ = empty_aabb();
    int levels_ = 0;
};

} // namespace fast
