#pragma once

// The tree that the surface area heuristic gives, built one split at a time [MacDonald and Booth 1990;
// Wald 2007].

#include "ref/trees/tree.h"

#include <span>

namespace ref {

/// Relative costs of entering a node and of testing a primitive, for the builder and for quality.h.
constexpr double C_trav = 1;
constexpr double C_isect = 1;

/// From the top down, each node is split at the best of all positions along all three axes (a full
/// sweep in the order of centroids). A leaf has one primitive, or at most `max_leaf_size` where
/// testing all of them is expected to cost no more than the best split. The boxes must be finite and
/// not empty.
Tree build_sah(std::span<const Aabb> boxes, std::size_t max_leaf_size = 1);

} // namespace ref
