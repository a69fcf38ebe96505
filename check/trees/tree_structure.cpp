// Properties of single nodes and leaves.

#include "check/trees/tree_properties.h"

namespace check {

std::string node_text(std::int64_t node)
{
    return "node " + std::to_string(node);
}

std::span<const std::int64_t> slots_of(const NeutralTree& tree, std::size_t node)
{
    const auto slots = static_cast<std::int64_t>(tree.primitives.size());
    const std::int64_t first = tree.first_slot(node);
    const std::int64_t count = tree.slot_count(node);
    if (!tree.is_leaf(node) || first < 0 || count < 0 || first > slots || count > slots - first)
        return {};
    return std::span(tree.primitives)
        .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count));
}

Property check_sizes(const NeutralTree& tree)
{
    Findings found("sizes", "there are as many boxes (and parents) as nodes");
    const std::size_t nodes = tree.size();
    if (tree.nodes.size() != nodes * (tree.width + 2))
        found.add([&] {
            return std::to_string(tree.nodes.size()) + " numbers of nodes are no multiple of " +
                   std::to_string(tree.width + 2);
        });
    if (tree.boxes.size() != nodes)
        found.add([&] {
            return std::to_string(nodes) + " nodes have " + std::to_string(tree.boxes.size()) + " boxes";
        });
    if (!tree.parents.empty() && tree.parents.size() != nodes)
        found.add([&] {
            return std::to_string(nodes) + " nodes have " + std::to_string(tree.parents.size()) +
                   " parents";
        });
    return found.take();
}

Property check_nodes(const NeutralTree& tree, std::size_t primitives)
{
    Findings found("nodes", "each node has either children or primitives");
    for (std::size_t node = 0; node < tree.size(); ++node) {
        const auto number = static_cast<std::int64_t>(node);
        const std::int64_t count = tree.slot_count(node);
        if (tree.is_leaf(node)) {
            // Of no primitives there may be a tree of one empty leaf.
            const bool may_be_empty = primitives == 0 && tree.size() == 1 && count == 0;
            if (count <= 0 && !may_be_empty)
                found.add([&] { return node_text(number) + " has neither children nor primitives"; },
                          number);
            continue;
        }
        if (count != 0)
            found.add(
                [&] {
                    return node_text(number) + " has children, and " + std::to_string(count) +
                           " primitives";
                },
                number);
        const auto children = tree.children(node);
        if (tree.width == 2 && (children[0] == NeutralTree::none || children[1] == NeutralTree::none))
            found.add([&] { return node_text(number) + " of a binary tree has one child"; }, number);
    }
    return found.take();
}

Property check_indices(const NeutralTree& tree, std::size_t primitives)
{
    Findings found("indices", "each child, slot and primitive that a node names exists");
    for (std::size_t node = 0; node < tree.size(); ++node) {
        const auto number = static_cast<std::int64_t>(node);
        for (const std::int64_t child : tree.children(node))
            if (child != NeutralTree::none && !is_node(tree, child))
                found.add(
                    [&] {
                        return node_text(number) + " has the child " + std::to_string(child) +
                               ": there are " + std::to_string(tree.size()) + " nodes";
                    },
                    number);
        if (!tree.is_leaf(node) || tree.slot_count(node) == 0) continue;
        const auto slots = slots_of(tree, node);
        if (slots.empty() && tree.slot_count(node) > 0)
            found.add(
                [&] {
                    return node_text(number) + " has " + std::to_string(tree.slot_count(node)) +
                           " slots from " + std::to_string(tree.first_slot(node)) + " on: there are " +
                           std::to_string(tree.primitives.size());
                },
                number);
        for (const std::int64_t primitive : slots)
            if (primitive < 0 || static_cast<std::size_t>(primitive) >= primitives)
                found.add(
                    [&] {
                        return node_text(number) + " holds primitive " + std::to_string(primitive) +
                               ": there are " + std::to_string(primitives);
                    },
                    number, primitive);
    }
    return found.take();
}

Property check_leaves(const NeutralTree& tree, std::size_t primitives)
{
    Findings found("primitives", "each primitive is in exactly one leaf");
    std::vector<std::int64_t> leaf_of(primitives, NeutralTree::none);
    for (std::size_t node = 0; node < tree.size(); ++node)
        for (const std::int64_t primitive : slots_of(tree, node)) {
            if (primitive < 0 || static_cast<std::size_t>(primitive) >= primitives) continue;
            std::int64_t& leaf = leaf_of[static_cast<std::size_t>(primitive)];
            const auto number = static_cast<std::int64_t>(node);
            if (leaf != NeutralTree::none)
                found.add(
                    [&] {
                        return "primitive " + std::to_string(primitive) +
                               (leaf == number
                                    ? " is twice in " + node_text(leaf)
                                    : " is in " + node_text(leaf) + " and in " + node_text(number));
                    },
                    number, primitive);
            leaf = number;
        }
    for (std::size_t primitive = 0; primitive < primitives; ++primitive)
        if (leaf_of[primitive] == NeutralTree::none)
            found.add([&] { return "primitive " + std::to_string(primitive) + " is in no leaf"; },
                      NeutralTree::none, static_cast<std::int64_t>(primitive));
    return found.take();
}

} // namespace check
