#pragma once

// Collapses a binary tree into one of up to eight children per node, whose leaves are groups of up to
// most_in_group triangles [Wald, Benthin, Boulos 2008].
//
// Each binary node gets a role: it becomes a wide node, it becomes a group, or it is merged into the
// wide node or group of an ancestor. The children of a wide node are found from its own subtree
// (division.h). Whether a binary node becomes a wide node depends on its ancestors. So wide nodes are
// found level by level, from the root down. The order in which threads find them varies; their
// numbers do not: they follow the numbers of the binary nodes. So every executor makes the same tree,
// and neighbours in space stay neighbours in memory.

#include "cuda/parallel/atomic.h"
#include "cuda/parallel/buffer.h"
#include "cuda/parallel/executor.h"
#include "cuda/parallel/radix_sort.h"
#include "cuda/trees/division.h"
#include "cuda/trees/triangle_group.h"

#include <array>
#include <cstdint>
#include <limits>
#include <span>

namespace fast {

/// A wide tree as traversal reads it. Without nodes the tree is group 0, if there is one.
struct WideTreeView {
    std::span<const WideNode> nodes;
    std::span<const TriangleGroup> groups;
    Aabb bounds; // of the root
};

/// The role of a node or leaf of the binary tree in the wide one. Sorting by role brings wide nodes to
/// the front, then groups.
constexpr std::uint32_t wide_node_role = 0;
constexpr std::uint32_t group_role = 1;
constexpr std::uint32_t merged_role = 2; // into the wide node or group of an ancestor

/// Nodes and leaves numbered through along the curve: leaf l is 2 l, internal node i, of whose range i
/// is one end, 2 i + 1. So groups that lie side by side are stored side by side.
HD constexpr std::uint32_t number_of(std::uint32_t child)
{
    return is_leaf(child) ? child << 1 : child << 1 | 1;
}

/// The inverse.
HD constexpr std::uint32_t child_of(std::uint32_t number)
{
    return (number & 1) != 0 ? number >> 1 : number >> 1 | leaf_bit;
}

/// Kernel over nodes and leaves: gives the root its role, and all others the role merged_role for now.
/// Clears the arrivals for DivideNodes.
struct BeginWideTree {
    std::uint32_t root; // its number
    std::uint32_t root_role;
    std::span<std::uint32_t> roles;
    std::span<std::uint32_t> numbers;
    std::span<std::uint32_t> found;    // wide nodes, in the order in which they are found
    std::span<std::uint32_t> counts;   // of wide nodes, of groups
    std::span<std::uint32_t> arrivals; // one per node

    HD void operator()(std::uint32_t i) const
    {
        if (i < arrivals.size()) arrivals[i] = 0;
        roles[i] = i == root ? root_role : merged_role;
        numbers[i] = i;
        if (i != root) return;
        if (!found.empty()) found[0] = 0;
        counts[0] = root_role == wide_node_role ? 1 : 0;
        counts[1] = root_role == group_role ? 1 : 0;
    }
};

/// Kernel over the wide nodes of one level: finds those of the next.
struct FindWideNodes {
    std::span<const Node> nodes;
    std::span<const Division> divisions;
    std::uint32_t first; // of this level in `found`
    std::span<std::uint32_t> roles;
    std::span<std::uint32_t> found;
    std::span<std::uint32_t> counts;

    HD void operator()(std::uint32_t i) const
    {
        const OpenedNode node = opened(nodes, divisions, found[first + i]);
        for (int c = 0; c < node.count; ++c) {
            const std::uint32_t child = node.children[c];
            const bool group = node.groups[c];
            roles[number_of(child)] = group ? group_role : wide_node_role;
            const std::uint32_t place = arrive(counts[group ? 1 : 0]);
            if (!group) found[place] = child;
        }
    }
};

/// Kernel over wide nodes and groups, wide nodes first: the reference to each, as its parent will hold
/// it.
struct NameWideNodes {
    std::span<const std::uint32_t> numbers;
    std::uint32_t wide_nodes;
    std::span<std::uint32_t> names;

    HD void operator()(std::uint32_t i) const
    {
        names[numbers[i]] = i < wide_nodes ? i : (i - wide_nodes) | leaf_bit;
    }
};

/// Kernel over wide nodes: fills in children and boxes.
struct FillWideNodes {
    std::span<const Node> nodes;
    std::span<const Division> divisions;
    std::span<const std::uint32_t> numbers;
    std::span<const std::uint32_t> names;
    std::span<WideNode> wide;

    HD void operator()(std::uint32_t i) const
    {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        const OpenedNode node = opened(nodes, divisions, child_of(numbers[i]));
        for (int c = 0; c < most_children; ++c) {
            const bool there = c < node.count;
            wide[i].children[c] = there ? names[number_of(node.children[c])] : no_node;
            for (int axis = 0; axis < 3; ++axis) {
                wide[i].planes[axis][c] = there ? node.boxes[c].lower[axis] : infinity;
                wide[i].planes[3 + axis][c] = there ? node.boxes[c].upper[axis] : -infinity;
            }
        }
    }
};

/// Kernel over groups: fills in primitives and vertices. A sphere has its number here, and NaN vertices.
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
        Triangle absent;
        for (Vec3& vertex : absent.vertices) vertex = Vec3(std::numeric_limits<float>::quiet_NaN());
        for (std::uint32_t lane = 0; lane < most_in_group; ++lane) {
            const std::uint32_t primitive = lane < count ? primitives[leaves[lane]] : no_primitive;
            groups[i].primitives[lane] = primitive;
            const Triangle& triangle = primitive < triangles.size() ? triangles[primitive] : absent;
            for (int k = 0; k < 3; ++k)
                for (int axis = 0; axis < 3; ++axis)
                    groups[i].vertices[k][axis][static_cast<int>(lane)] = triangle.vertices[k][axis];
        }
    }
};

/// Builds and owns a wide tree.
class WideTree {
public:
    /// Of a tree (node.h) whose leaves, with these links, hold `primitives`, of which the first are
    /// `triangles`; all in `memory`, which is that of the kernels of `executor`. Waits for every level.
    /// Throws OutOfMemory.
    template <Executor E>
    WideTree(Memory& memory, E& executor, std::span<const Node> nodes,
             std::span<const std::uint32_t> leaf_links, std::span<const std::uint32_t> primitives,
             std::span<const Triangle> triangles)
        : nodes_(memory, 0), groups_(memory, 0)
    {
        if (primitives.empty()) return;
        const auto all = static_cast<std::uint32_t>(nodes.size() + primitives.size());
        std::array<Buffer<std::uint32_t>, 2> roles{Buffer<std::uint32_t>(memory, all),
                                                   Buffer<std::uint32_t>(memory, all)};
        std::array<Buffer<std::uint32_t>, 2> numbers{Buffer<std::uint32_t>(memory, all),
                                                     Buffer<std::uint32_t>(memory, all)};
        Buffer<std::uint32_t> found(memory, nodes.size());
        Buffer<std::uint32_t> counts(memory, 2);
        Buffer<std::uint32_t> arrivals(memory, nodes.size());
        Buffer<Division> divisions(memory, nodes.size());
        executor(all, BeginWideTree{number_of(nodes.empty() ? leaf_bit : 0),
                                    primitives.size() > most_in_group ? wide_node_role : group_role,
                                    roles[0].all(), numbers[0].all(), found.all(), counts.all(),
                                    arrivals.all()});
        if (!nodes.empty())
            executor(static_cast<std::uint32_t>(primitives.size()),
                     DivideNodes{nodes, leaf_links, arrivals.all(), divisions.all()});
        std::uint32_t wide_nodes = 0;
        for (std::uint32_t next = counts.read(1)[0]; next > wide_nodes; next = counts.read(1)[0]) {
            executor(next - wide_nodes, FindWideNodes{nodes, divisions.all(), wide_nodes, roles[0].all(),
                                                      found.all(), counts.all()});
            wide_nodes = next;
            ++levels_;
        }
        const std::uint32_t groups = counts.read(2)[1];

        Alternating<std::uint32_t> role{roles[0].all(), roles[1].all()};
        Alternating<std::uint32_t> number{numbers[0].all(), numbers[1].all()};
        Buffer<std::uint32_t> scratch(memory,
                                      sort_scratch<std::uint32_t, std::uint32_t>(executor, all, 2));
        radix_sort(executor, role, number, 2, scratch.all());

        const std::span<std::uint32_t> names = number.other;
        executor(wide_nodes + groups, NameWideNodes{number.current, wide_nodes, names});
        nodes_ = Buffer<WideNode>(memory, wide_nodes);
        groups_ = Buffer<TriangleGroup>(memory, groups);
        executor(wide_nodes, FillWideNodes{nodes, divisions.all(), number.current, names, nodes_.all()});
        executor(groups, FillGroups{nodes, number.current.subspan(wide_nodes), primitives, triangles,
                                    groups_.all()});
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
