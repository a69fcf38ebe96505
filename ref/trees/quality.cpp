#include "ref/trees/quality.h"

#include "ref/trees/sah.h"

#include <algorithm>
#include <vector>

namespace ref {

Quality quality(const Tree& tree)
{
    Quality result;
    if (tree.nodes.empty()) return result;
    const double root_area = half_area(tree.bounds[0]);
    const auto share = [&](const Aabb& box) { return root_area > 0 ? half_area(box) / root_area : 1; };

    struct Visit {
        std::uint32_t node;
        int depth;
    };
    std::vector<Visit> visits{{0, 0}};
    while (!visits.empty()) {
        const auto [node, depth] = visits.back();
        visits.pop_back();
        const Aabb& bounds = tree.bounds[node];
        if (tree.is_leaf(node)) {
            const std::uint32_t leaf = tree.leaf(node);
            const std::uint32_t count = tree.leaf_begin[leaf + 1] - tree.leaf_begin[leaf];
            result.sah_cost += C_isect * count * share(bounds); // map: sah-cost
            result.depth = std::max(result.depth, depth);
            result.mean_leaf_depth += static_cast<double>(depth) / tree.leaf_count();
        } else {
            result.sah_cost += C_trav * share(bounds); // map: sah-cost
            const auto [left, right] = tree.nodes[node].children;
            const Aabb both = intersection(tree.bounds[left], tree.bounds[right]);
            if (!is_empty(both)) result.overlap += share(both);
            visits.push_back({left, depth + 1});
            visits.push_back({right, depth + 1});
        }
    }
    return result;
}

} // namespace ref
