#include "ref/trees/is_valid_tree.h"

#include <algorithm>

namespace ref {

namespace {

class Violations {
public:
    template <typename... Parts>
    void add(const Parts&... parts)
    {
        std::string line;
        ((line += text(parts)), ...);
        lines_.push_back(line);
    }
    [[nodiscard]] bool none() const { return lines_.empty(); }
    std::vector<std::string> take() { return std::move(lines_); }

private:
    static std::string text(const char* part) { return part; }
    static std::string text(std::uint64_t part) { return std::to_string(part); }
    std::vector<std::string> lines_;
};

void check_sizes(const Tree& tree, std::size_t primitives, Violations& violations)
{
    const std::size_t leaves = tree.leaf_count();
    const std::size_t expected = leaves == 0 ? 0 : 2 * leaves - 1;
    if (tree.nodes.size() != expected)
        violations.add(leaves, " leaves need ", expected, " nodes, not ", tree.nodes.size());
    if (tree.bounds.size() != tree.nodes.size())
        violations.add(tree.nodes.size(), " nodes need as many boxes, not ", tree.bounds.size());
    if (primitives > 0 && leaves == 0) violations.add("no leaf for ", primitives, " primitives");
}

void check_leaves(const Tree& tree, std::size_t primitives, Violations& violations)
{
    const auto& begin = tree.leaf_begin;
    if (!begin.empty() && (begin.front() != 0 || begin.back() != tree.primitives.size()))
        violations.add("the leaves do not divide the list of primitives");
    for (std::size_t leaf = 0; leaf + 1 < begin.size(); ++leaf)
        if (begin[leaf] >= begin[leaf + 1]) violations.add("leaf ", leaf, " is empty");
    std::vector<std::size_t> held(primitives, 0);
    for (const std::uint32_t primitive : tree.primitives) {
        if (primitive < primitives)
            ++held[primitive];
        else
            violations.add("there is no primitive ", primitive);
    }
    for (std::size_t primitive = 0; primitive < primitives; ++primitive)
        if (held[primitive] != 1)
            violations.add("primitive ", primitive, " is held ", held[primitive], " times");
}

void check_links(const Tree& tree, Violations& violations)
{
    std::vector<std::size_t> parents(tree.nodes.size(), 0);
    for (std::uint32_t node = 0; node < tree.nodes.size(); ++node)
        for (const std::uint32_t child : tree.nodes[node].children) {
            if (tree.is_leaf(node)) {
                if (child != no_node) violations.add("leaf node ", node, " has a child");
            } else if (child >= tree.nodes.size()) {
                violations.add("node ", node, " has a child that is not there");
            } else {
                ++parents[child];
                if (tree.nodes[child].parent != node)
                    violations.add("node ", child, " does not name its parent ", node);
            }
        }
    for (std::size_t node = 0; node < tree.nodes.size(); ++node) {
        if (parents[node] != (node == 0 ? 0 : 1))
            violations.add("node ", node, " has ", parents[node], " parents");
        if (node == 0 && tree.nodes[0].parent != no_node) violations.add("the root has a parent");
    }
}

/// The nodes below the root, ordered so that children come before their parents. Some nodes are
/// missing if the links have a cycle, which check_links alone does not detect.
std::vector<std::uint32_t> bottom_up(const Tree& tree)
{
    std::vector<std::uint32_t> order;
    if (!tree.nodes.empty()) order.push_back(0);
    std::size_t next = 0;
    while (next < order.size()) {
        const std::uint32_t node = order[next++];
        if (tree.is_leaf(node)) continue;
        const auto& children = tree.nodes[node].children;
        order.insert(order.end(), children.begin(), children.end());
    }
    std::reverse(order.begin(), order.end());
    return order;
}

/// The first and the last leaf below each node. Adds a violation where the ranges of two children do
/// not adjoin.
std::vector<std::array<std::uint32_t, 2>> leaf_ranges(const Tree& tree, Violations& violations)
{
    std::vector<std::array<std::uint32_t, 2>> ranges(tree.nodes.size());
    for (const std::uint32_t node : bottom_up(tree)) {
        if (tree.is_leaf(node)) {
            ranges[node] = {tree.leaf(node), tree.leaf(node)};
            continue;
        }
        const auto [left, right] = tree.nodes[node].children;
        if (ranges[left][1] + 1 != ranges[right][0])
            violations.add("the leaves below node ", node, " are not one range");
        ranges[node] = {ranges[left][0], ranges[right][1]};
    }
    return ranges;
}

void check_boxes(const Tree& tree, std::span<const Aabb> primitive_bounds, Violations& violations)
{
    for (std::uint32_t node = 0; node < tree.nodes.size(); ++node) {
        Aabb expected;
        if (tree.is_leaf(node)) {
            const std::uint32_t leaf = tree.leaf(node);
            for (std::uint32_t i = tree.leaf_begin[leaf]; i < tree.leaf_begin[leaf + 1]; ++i)
                expected = unite(expected, primitive_bounds[tree.primitives[i]]);
        } else {
            for (const std::uint32_t child : tree.nodes[node].children)
                expected = unite(expected, tree.bounds[child]);
        }
        if (!(tree.bounds[node] == expected))
            violations.add("the box of node ", node, " is not the union of those below it");
    }
}

} // namespace

std::vector<std::string> is_valid_tree(const Tree& tree, std::span<const Aabb> primitive_bounds)
{
    Violations violations;
    check_sizes(tree, primitive_bounds.size(), violations);
    check_leaves(tree, primitive_bounds.size(), violations);
    if (!violations.none()) return violations.take();
    check_links(tree, violations);
    if (!violations.none()) return violations.take();
    if (const std::size_t reached = bottom_up(tree).size(); reached != tree.nodes.size())
        violations.add(tree.nodes.size() - reached, " nodes cannot be reached from the root");
    if (!violations.none()) return violations.take();
    leaf_ranges(tree, violations);
    check_boxes(tree, primitive_bounds, violations);
    return violations.take();
}

std::vector<std::string> is_valid_radix_tree(const Tree& tree, Codes codes)
{
    Violations violations;
    if (tree.leaf_count() != codes.size())
        violations.add(codes.size(), " codes need as many leaves, not ", tree.leaf_count());
    if (!violations.none()) return violations.take();
    const auto ranges = leaf_ranges(tree, violations);
    const auto prefix = [&](std::uint32_t node) {
        return delta(codes, ranges[node][0], ranges[node][1]);
    };
    for (std::uint32_t node = 0; node < tree.internal_count(); ++node)
        for (const std::uint32_t child : tree.nodes[node].children)
            if (!tree.is_leaf(child) && prefix(child) <= prefix(node))
                violations.add("the common prefix of node ", child,
                               " is not longer than that of its parent ", node);
    return violations.take();
}

} // namespace ref
