#pragma once

// Nodes of four children, for rays: half as many steps from the root to a leaf, and four boxes tested by
// one instruction where the processor has one for four floats [Wald, Benthin, Boulos 2008].

#include "cuda/parallel/lanes.h"
#include "cuda/trees/half_area.h"
#include "cuda/trees/node.h"

#include <cstdint>
#include <limits>
#include <span>

namespace gpu {

/// Up to four children, the boxes coordinate by coordinate. A child that is not there has no_node for a
/// name and a box that no ray enters. Two cache lines.
struct alignas(64) WideNode {
    Lanes bounds[2][3];        // lower, upper; x, y, z
    std::uint32_t children[4]; // a leaf, or the wide node of that number
};
static_assert(sizeof(WideNode) == 128);

/// Kernel over inner nodes: makes of every node the wide node that begins there, by opening twice the
/// child with the largest surface [Wald et al. 2008, sec. 3.1]. So each can be made without knowing
/// which of them are needed. A ray that starts at node 0 never comes to the others.
struct WidenNodes {
    std::span<const Node> nodes;
    std::span<WideNode> wide;

    HD void operator()(std::uint32_t i) const
    {
        Box boxes[4] = {nodes[i].bounds[0], nodes[i].bounds[1]};
        std::uint32_t children[4] = {nodes[i].children[0], nodes[i].children[1], no_node, no_node};
        int count = 2;
        while (count < 4) {
            int largest = -1;
            for (int c = 0; c < count; ++c)
                if (!is_leaf(children[c]) &&
                    (largest < 0 || half_area(boxes[c]) > half_area(boxes[largest])))
                    largest = c;
            if (largest < 0) break;
            const Node& opened = nodes[children[largest]];
            for (int side = 0; side < 2; ++side) {
                const int to = side == 0 ? largest : count;
                boxes[to] = opened.bounds[side];
                children[to] = opened.children[side];
            }
            ++count;
        }
        constexpr float infinity = std::numeric_limits<float>::infinity();
        for (int c = 0; c < 4; ++c) {
            wide[i].children[c] = children[c];
            for (int axis = 0; axis < 3; ++axis) {
                wide[i].bounds[0][axis][c] = c < count ? boxes[c].lower[axis] : infinity;
                wide[i].bounds[1][axis][c] = c < count ? boxes[c].upper[axis] : -infinity;
            }
        }
    }
};

} // namespace gpu
