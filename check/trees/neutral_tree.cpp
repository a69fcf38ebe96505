#include "check/trees/neutral_tree.h"

namespace check {

NeutralTree neutral(const ref::Tree& tree)
{
    const auto number = [](std::uint32_t node) {
        return node == ref::no_node ? NeutralTree::none : static_cast<std::int64_t>(node);
    };
    NeutralTree result;
    for (std::uint32_t node = 0; node < tree.nodes.size(); ++node) {
        const auto [left, right] = tree.nodes[node].children;
        std::int64_t first = 0;
        std::int64_t count = 0;
        if (tree.is_leaf(node)) {
            first = tree.leaf_begin[tree.leaf(node)];
            count = tree.leaf_begin[tree.leaf(node) + 1] - first;
        }
        for (const std::int64_t value : {number(left), number(right), first, count})
            result.nodes.push_back(value);
        result.parents.push_back(number(tree.nodes[node].parent));
    }
    result.boxes = tree.bounds;
    result.primitives.assign(tree.primitives.begin(), tree.primitives.end());
    return result;
}

} // namespace check
