#pragma once

// The quality of a tree, computed on the host.

#include "cuda/trees/node.h"

#include <span>

namespace fast {

/// The expected cost of a ray that hits the root's box, with C_trav = C_isect = 1 and one primitive
/// per leaf: the areas of all nodes and leaves, divided by that of the root [Goldsmith and Salmon
/// 1987]. The box of every node but the root is stored in its parent. 1 if there is no internal node.
inline double sah_cost(std::span<const Node> nodes)
{
    if (nodes.empty()) return 1;
    const double root = half_area(unite(nodes[0].bounds[0], nodes[0].bounds[1]));
    double sum = 0;
    for (const Node& node : nodes)
        for (const Aabb& box : node.bounds) sum += root > 0 ? half_area(box) / root : 1; // map: sah-cost
    return 1 + sum;
}

} // namespace fast
