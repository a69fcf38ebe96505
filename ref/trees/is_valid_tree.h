#pragma once

// Whether a tree is one.

#include "ref/trees/radix_tree.h"
#include "ref/trees/tree.h"

#include <span>
#include <string>
#include <vector>

namespace ref {

/// Everything that is wrong with `tree` as a tree over these primitives, one line each; nothing if it is
/// valid: every node but the root has one parent, and is its child; leaves hold each primitive once;
/// every node covers a contiguous range of leaves; every box is, bit for bit, the union of those below
/// it. Does not trust the tree: no index in it is followed unchecked, and cycles end.
std::vector<std::string> is_valid_tree(const Tree& tree, std::span<const Aabb> primitive_bounds);

/// What is wrong with `tree` as a radix tree over the sorted `codes`, given that it is valid: the prefix
/// that all keys of a node share must be strictly shorter than those of its children.
std::vector<std::string> is_valid_radix_tree(const Tree& tree, Codes codes);

} // namespace ref
