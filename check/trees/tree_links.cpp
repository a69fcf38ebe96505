// Properties of parents and children: one root, one parent each, all nodes reached.

#include "check/trees/tree_properties.h"

namespace check {

namespace {

/// Which node has this node as a child: the first such node; `none` if there is none.
using Parents = std::vector<std::int64_t>;

Property check_one_parent(const NeutralTree& tree, Parents& parents)
{
    Findings found("one-parent", "no node is a child twice");
    parents.assign(tree.size(), NeutralTree::none);
    for (std::size_t node = 0; node < tree.size(); ++node)
        for (const std::int64_t child : tree.children(node)) {
            if (!is_node(tree, child)) continue;
            std::int64_t& parent = parents[static_cast<std::size_t>(child)];
            const auto number = static_cast<std::int64_t>(node);
            if (parent != NeutralTree::none)
                found.add(
                    [&] {
                        return node_text(child) + (parent == number
                                                       ? " is twice a child of " + node_text(parent)
                                                       : " is a child of " + node_text(parent) +
                                                             " and of " + node_text(number));
                    },
                    child);
            else
                parent = number;
        }
    return found.take();
}

Property check_one_root(const NeutralTree& tree, const Parents& parents, std::size_t primitives,
                        std::int64_t& root)
{
    Findings found("one-root", "there is exactly one root");
    root = NeutralTree::none;
    if (tree.size() == 0) {
        if (primitives > 0)
            found.add(
                [&] { return "there is no node for " + std::to_string(primitives) + " primitives"; });
        return found.take();
    }
    if (tree.root) {
        if (!is_node(tree, *tree.root)) {
            found.add([&] {
                return "the root is " + node_text(*tree.root) + ": there are " +
                       std::to_string(tree.size()) + " nodes";
            });
            return found.take();
        }
        root = *tree.root;
        const std::int64_t parent = parents[static_cast<std::size_t>(root)];
        if (parent != NeutralTree::none)
            found.add(
                [&] { return "the root, " + node_text(root) + ", is a child of " + node_text(parent); },
                root);
        return found.take();
    }
    for (std::size_t node = 0; node < tree.size(); ++node) {
        if (parents[node] != NeutralTree::none) continue;
        const auto number = static_cast<std::int64_t>(node);
        if (root == NeutralTree::none)
            root = number;
        else
            found.add(
                [&] { return node_text(root) + " and " + node_text(number) + " are nobody's child"; },
                number);
    }
    if (root == NeutralTree::none) found.add([] { return "every node is a child of another node"; });
    return found.take();
}

/// Whether the chain of parents from `node` up comes back to a node of its own.
bool is_below_a_cycle(const Parents& parents, std::int64_t node)
{
    for (std::size_t steps = 0; steps <= parents.size(); ++steps) {
        if (node == NeutralTree::none) return false;
        node = parents[static_cast<std::size_t>(node)];
    }
    return true;
}

Property check_reachable(const NeutralTree& tree, const Parents& parents, std::int64_t root)
{
    Findings found("reachable", "each node is reached from the root, without a cycle");
    std::vector<bool> reached(tree.size(), false);
    std::vector<std::int64_t> open;
    const auto visit = [&](std::int64_t node) {
        if (!is_node(tree, node) || reached[static_cast<std::size_t>(node)]) return;
        reached[static_cast<std::size_t>(node)] = true;
        open.push_back(node);
    };
    visit(root);
    while (!open.empty()) {
        const auto node = static_cast<std::size_t>(open.back());
        open.pop_back();
        for (const std::int64_t child : tree.children(node)) visit(child);
    }
    for (std::size_t node = 0; node < tree.size(); ++node)
        if (!reached[node])
            found.add(
                [&] {
                    const auto number = static_cast<std::int64_t>(node);
                    return node_text(number) + " is not reached from the root" +
                           (root == NeutralTree::none ? "" : ", " + node_text(root)) +
                           (is_below_a_cycle(parents, number) ? ": it is in a cycle or below one" : "");
                },
                static_cast<std::int64_t>(node));
    return found.take();
}

Property check_parents(const NeutralTree& tree, const Parents& parents)
{
    Findings found("parents", "the parent that a node names has it as a child");
    for (std::size_t node = 0; node < tree.size(); ++node)
        if (tree.parents[node] != parents[node])
            found.add(
                [&] {
                    const auto name = [](std::int64_t parent) {
                        return parent == NeutralTree::none ? std::string("no parent")
                                                           : node_text(parent);
                    };
                    return node_text(static_cast<std::int64_t>(node)) + " names " +
                           name(tree.parents[node]) +
                           (parents[node] == NeutralTree::none
                                ? ", and is nobody's child"
                                : ", and is a child of " + name(parents[node]));
                },
                static_cast<std::int64_t>(node));
    return found.take();
}

} // namespace

std::vector<Property> check_links(const NeutralTree& tree, std::size_t primitives, std::int64_t& root)
{
    Parents parents;
    std::vector<Property> result = {check_one_parent(tree, parents)};
    result.push_back(check_one_root(tree, parents, primitives, root));
    result.push_back(check_reachable(tree, parents, root));
    if (!tree.parents.empty()) result.push_back(check_parents(tree, parents));
    return result;
}

} // namespace check
