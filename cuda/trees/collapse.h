#pragma once

// The kernels that collapse a binary tree into a wide one (wide_tree.h).
//
// Each binary node gets a role: it becomes a wide node, it becomes a group, or it is merged into the
// wide node or group of an ancestor. The children of a wide node are found from its own subtree
// (division.h). Whether a binary node becomes a wide node depends on its ancestors. So wide nodes are
// found level by level, from the root down. The order in which threads find them varies; their numbers
// do not: they follow the numbers of the binary nodes. So every executor makes the same tree, and
// neighbours in space stay neighbours in memory.

#include "cuda/parallel/atomic.h"
#include "cuda/parallel/prefetch.h"
#include "cuda/trees/division.h"
#include "cuda/trees/triangle_group.h"

#include <cstdint>
#include <limits>
#include <span>

namespace fast {

/// The children of a wide node, from left to right, each by the link to it (node.h).
struct OpenedNode {
    std::uint32_t links[most_children];
    int count;
};

/// The children of a wide node: the best division of the subtree below `node`, which is no group.
///
/// Goes down level by level, not child by child: so a processor reads all nodes of a level from memory
/// at the same time.
HD inline OpenedNode opened(std::span<const Node> nodes, std::span<const Division> divisions,
                            std::uint32_t node)
{
    struct Level {
        OpenedNode node;
        int parts[most_children]; // into which a child may be divided

        HD void add(std::uint32_t link, int most_parts)
        {
            node.links[node.count] = link;
            parts[node.count++] = most_parts;
        }
        HD void add_children(std::uint32_t parent, const Division& division, int into)
        {
            const int to_left = division.to_left(into);
            add(link_to(parent, 0), to_left);
            add(link_to(parent, 1), into - to_left);
        }
    };
    Level level{};
    level.add_children(node, divisions[node], most_children);
    for (bool divided = true; divided;) {
        divided = false;
        Level next{};
        for (int i = 0; i < level.node.count; ++i) {
            const std::uint32_t link = level.node.links[i];
            const int parts = level.parts[i];
            const std::uint32_t child = parts > 1 ? child_at(nodes, link) : leaf_bit;
            if (is_leaf(child) || !divisions[child].divided(parts)) {
                next.add(link, 1);
                continue;
            }
            prefetch(nodes[child]);
            next.add_children(child, divisions[child], parts);
            divided = true;
        }
        level = next;
    }
    return level.node;
}

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

/// A place among the children of wide nodes: child c of the one that was found as number p.
HD constexpr std::uint32_t place_of(std::uint32_t p, int c)
{
    return p * most_children + static_cast<std::uint32_t>(c);
}

/// The wide nodes and the groups in the order in which they are found.
struct FoundNodes {
    std::span<std::uint32_t> counts; // of wide nodes, of groups
    // One per wide node:
    std::span<std::uint32_t> numbers; // of the binary node
    std::span<std::uint32_t> order;   // 0, 1, 2, ...
    std::span<std::uint32_t> places;  // among the children of the parent; no_node for the root
    std::span<OpenedNode> opened;
    // One per group:
    std::span<std::uint32_t> group_numbers;
    std::span<std::uint32_t> group_places;

    /// Wide node p.
    HD void put_node(std::uint32_t p, std::uint32_t node, std::uint32_t place) const
    {
        numbers[p] = number_of(node);
        order[p] = p;
        places[p] = place;
    }
    /// Group p.
    HD void put_group(std::uint32_t p, std::uint32_t child, std::uint32_t place) const
    {
        group_numbers[p] = number_of(child);
        group_places[p] = place;
    }
};

/// Kernel of one index: finds the root of a tree over so many primitives, at least one.
struct FindRoot {
    std::uint32_t primitives;
    FoundNodes found;

    HD void operator()(std::uint32_t /*index*/) const
    {
        const bool group = primitives <= most_in_group;
        found.counts[0] = group ? 0 : 1;
        found.counts[1] = group ? 1 : 0;
        if (group)
            found.put_group(0, primitives == 1 ? leaf_bit : 0, no_node);
        else
            found.put_node(0, 0, no_node);
    }
};

/// Kernel over the wide nodes of one level: finds those of the next.
struct FindWideNodes {
    std::span<const Node> nodes;
    std::span<const Division> divisions;
    std::uint32_t first; // of this level
    FoundNodes found;

    HD void operator()(std::uint32_t i) const
    {
        const std::uint32_t p = first + i;
        const OpenedNode node = opened(nodes, divisions, child_of(found.numbers[p]));
        found.opened[p] = node;
        std::uint32_t groups = 0;
        for (int c = 0; c < node.count; ++c) groups += is_group(node, c) ? 1 : 0;
        std::uint32_t next_group = next_numbers(found.counts[1], groups);
        std::uint32_t next_node =
            next_numbers(found.counts[0], static_cast<std::uint32_t>(node.count) - groups);
        for (int c = 0; c < node.count; ++c) {
            const std::uint32_t child = child_at(nodes, node.links[c]);
            if (is_group(node, c))
                found.put_group(next_group++, child, place_of(p, c));
            else
                found.put_node(next_node++, child, place_of(p, c));
        }
    }

private:
    [[nodiscard]] HD bool is_group(const OpenedNode& node, int c) const
    {
        const std::uint32_t child = child_at(nodes, node.links[c]);
        return is_leaf(child) || divisions[child].is_group();
    }
};

/// Kernel over wide nodes, in the order of their numbers: where each is.
struct RankWideNodes {
    std::span<const std::uint32_t> order;
    std::span<std::uint32_t> ranks;

    HD void operator()(std::uint32_t i) const { ranks[order[i]] = i; }
};

/// Writes `child` to its place among the children of wide nodes.
HD inline void put_child(std::span<WideNode> wide, std::span<const std::uint32_t> ranks,
                         std::uint32_t place, std::uint32_t child)
{
    if (place != no_node) wide[ranks[place / most_children]].children[place % most_children] = child;
}

/// Kernel over wide nodes, in the order of their numbers: fills in the boxes, and the reference from the
/// parent.
struct FillWideNodes {
    std::span<const Node> nodes;
    FoundNodes found;
    std::span<const std::uint32_t> order;
    std::span<const std::uint32_t> ranks;
    std::span<WideNode> wide;

    HD void operator()(std::uint32_t i) const
    {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        const OpenedNode& node = found.opened[order[i]];
        for (int c = 0; c < most_children; ++c) {
            const bool there = c < node.count;
            if (!there) wide[i].children[c] = no_node;
            for (int axis = 0; axis < 3; ++axis) {
                wide[i].planes[axis][c] = there ? box_at(nodes, node.links[c]).lower[axis] : infinity;
                wide[i].planes[3 + axis][c] =
                    there ? box_at(nodes, node.links[c]).upper[axis] : -infinity;
            }
        }
        put_child(wide, ranks, found.places[order[i]], i);
    }
};

/// Kernel over groups, in the order of their numbers: fills in the primitives, and the reference from
/// the parent.
struct BeginGroups {
    std::span<const Node> nodes;
    std::span<const std::uint32_t> numbers;
    std::span<const std::uint32_t> places;
    std::span<const std::uint32_t> primitives; // by leaf
    std::span<const std::uint32_t> ranks;
    std::span<WideNode> wide;
    std::span<TriangleGroup> groups;

    HD void operator()(std::uint32_t i) const
    {
        std::uint32_t leaves[most_in_group];
        const std::uint32_t count = leaves_below(nodes, child_of(numbers[i]), leaves);
        for (std::uint32_t lane = 0; lane < most_in_group; ++lane)
            groups[i].primitives[lane] = lane < count ? primitives[leaves[lane]] : no_primitive;
        put_child(wide, ranks, places[i], i | leaf_bit);
    }
};

/// Kernel over groups: fills in the vertices. A sphere has NaN vertices.
struct FillGroups {
    std::span<const Triangle> triangles; // by primitive
    std::span<TriangleGroup> groups;

    /// Triangles lie anywhere in memory, and so they are loaded this many groups ahead.
    static constexpr std::uint32_t ahead = 4;

    HD void operator()(std::uint32_t i) const
    {
        if (i + ahead < groups.size())
            for (const std::uint32_t primitive : groups[i + ahead].primitives)
                if (primitive < triangles.size()) prefetch(triangles[primitive]);
        Triangle absent;
        for (Vec3& vertex : absent.vertices) vertex = Vec3(std::numeric_limits<float>::quiet_NaN());
        for (std::uint32_t lane = 0; lane < most_in_group; ++lane) {
            const std::uint32_t primitive = groups[i].primitives[lane];
            const Triangle& triangle = primitive < triangles.size() ? triangles[primitive] : absent;
            for (int k = 0; k < 3; ++k)
                for (int axis = 0; axis < 3; ++axis)
                    groups[i].vertices[k][axis][static_cast<int>(lane)] = triangle.vertices[k][axis];
        }
    }
};

} // namespace fast
