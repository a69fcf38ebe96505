#include "extremes/trees/check_binary_tree.h"

#include <algorithm>
#include <vector>

namespace extremes {

namespace {

std::string numbered(const char* what, std::size_t number)
{
    return what + std::to_string(number);
}

/// Of a permutation of 0 to n - 1; empty if `primitives` is one.
std::string fault_of_primitives(const BinaryTree& tree)
{
    const std::size_t n = tree.boxes.size();
    if (tree.primitives.size() != n || tree.leaf_links.size() != n || tree.nodes.size() != n - 1)
        return "wrong numbers of nodes or leaves";
    std::vector<bool> held(n);
    for (const std::uint32_t primitive : tree.primitives) {
        if (primitive >= n || held[primitive]) return numbered("not each primitive once: ", primitive);
        held[primitive] = true;
    }
    return "";
}

bool same_box(const fast::Aabb& a, const fast::Aabb& b)
{
    return a.lower == b.lower && a.upper == b.upper;
}

/// Of the child on one side of a node.
std::string fault_of_child(const BinaryTree& tree, std::uint32_t node, std::uint32_t side)
{
    const std::uint32_t child = tree.nodes[node].children[side];
    const std::uint32_t number = child & ~fast::leaf_bit;
    const bool leaf = fast::is_leaf(child);
    if (number >= (leaf ? tree.leaf_links.size() : tree.nodes.size()))
        return numbered("no such child: of node ", node);
    // Each child has one link, so no two nodes can both pass this.
    if ((leaf ? tree.leaf_links[number] : tree.nodes[number].link) != fast::link_to(node, side))
        return numbered("a child is not linked to its node ", node);
    const fast::Aabb below =
        leaf ? tree.boxes[tree.primitives[number]]
             : fast::unite(tree.nodes[number].bounds[0], tree.nodes[number].bounds[1]);
    if (!same_box(tree.nodes[node].bounds[side], below)) return numbered("a wrong box in node ", node);
    return "";
}

} // namespace

CheckedTree checked(const BinaryTree& tree, bool leaves_in_order)
{
    if (tree.boxes.empty()) return {tree.nodes.empty() ? "" : "nodes over nothing"};
    if (const std::string fault = fault_of_primitives(tree); !fault.empty()) return {fault};
    const std::uint32_t root_link = tree.nodes.empty() ? tree.leaf_links[0] : tree.nodes[0].link;
    if (root_link != fast::no_node) return {"the root has a parent"};

    struct Visit {
        std::uint32_t child;
        int depth;
    };
    CheckedTree result;
    std::vector<Visit> stack{{tree.nodes.empty() ? fast::leaf_bit : 0, 0}};
    std::size_t reached = 0;
    std::uint32_t leaves = 0;
    while (!stack.empty()) {
        const auto [child, depth] = stack.back();
        stack.pop_back();
        ++reached;
        if (fast::is_leaf(child)) {
            if (leaves_in_order && (child & ~fast::leaf_bit) != leaves)
                return {numbered("not in its place: leaf ", child & ~fast::leaf_bit)};
            ++leaves;
            result.depth = std::max(result.depth, depth);
            continue;
        }
        for (const std::uint32_t side : {1u, 0u}) { // the left child is taken first
            if (const std::string fault = fault_of_child(tree, child, side); !fault.empty())
                return {fault};
            stack.push_back({tree.nodes[child].children[side], depth + 1});
        }
    }
    // A walk that follows links back and forth meets nothing twice; what it misses has no way up.
    if (reached != 2 * tree.boxes.size() - 1) return {"not all nodes can be reached from the root"};
    return result;
}

} // namespace extremes
