#pragma once

// Measures of the quality of a tree.

#include "ref/trees/tree.h"

namespace ref {

struct Quality {
    /// The expected cost of a ray that hits the root's box: the sum over internal nodes of C_trav A /
    /// A_root plus the sum over leaves of C_isect N A / A_root, where A is half the surface area of a
    /// box and N the number of primitives of a leaf [Goldsmith and Salmon 1987]. If the root has no
    /// area, every ratio counts as 1.
    double sah_cost = 0;
    int depth = 0; // edges from the root to the deepest leaf
    double mean_leaf_depth = 0;
    /// The sum over internal nodes of the half area of the intersection of both children's boxes,
    /// divided by A_root.
    double overlap = 0;
};

/// All zero for a tree without nodes.
Quality quality(const Tree& tree);

} // namespace ref
