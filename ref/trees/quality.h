#pragma once

// Numbers that say how good a tree is.

#include "ref/trees/tree.h"

namespace ref {

struct Quality {
    /// Expected cost of a ray that meets the root: sum over internal nodes of C_trav A / A_root, and
    /// over leaves of C_isect N A / A_root, A half the surface area of a box [Goldsmith and Salmon
    /// 1987]. Where the root has no area, every ratio counts as 1.
    double sah_cost = 0;
    int depth = 0; // edges from the root to the deepest leaf
    double mean_leaf_depth = 0;
    /// Sum over internal nodes of the half area that both children's boxes cover, over A_root.
    double overlap = 0;
};

/// All zero for a tree without nodes.
Quality quality(const Tree& tree);

} // namespace ref
