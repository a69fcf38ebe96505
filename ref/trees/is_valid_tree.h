#pragma once

// Checks of the structure of a tree.

#include "ref/trees/radix_tree.h"
#include "ref/trees/tree.h"

#include <span>
#include <string>
#include <vector>

namespace ref {

/// The list of everything that is wrong with `tree` as a tree over these primitives, one line each;
/// empty if it is valid. In a valid tree every node but the root has one parent and is its child; the
/// leaves hold each primitive once; every node covers a contiguous range of leaves; every box is, bit
/// for bit, the union of the boxes below it. Any input is safe: every index is checked before it is
/// followed, and cycles end.
std::vector<std::string> is_valid_tree(const Tree& tree, std::span<const Aabb> primitive_bounds);

/// The list of everything that is wrong with `tree` as a radix tree over the sorted `codes`, given
/// that it is valid: the prefix that all keys of a node share must be strictly shorter than those of
/// its children.
std::vector<std::string> is_valid_radix_tree(const Tree& tree, Codes codes);

} // namespace ref
