#pragma once

// The drawings of docs/tree-by-hand.md, as SVG documents.

#include "docs/figures/eight_keys.h"

#include <span>
#include <string>

namespace figures {

/// The sorted keys, delta between neighbours, and the direction of the range of each internal node.
std::string draw_keys(const EightKeys& keys);

/// The first two searches of all internal nodes, a row for each: every key that is asked, and the range.
std::string draw_ranges(const EightKeys& keys);

/// The third search of all internal nodes, and the splits.
std::string draw_splits(const EightKeys& keys);

/// The tree, with what each walk of the refit reads in the counter of a node when the walks start in
/// `leaf_order`.
std::string draw_refit(const EightKeys& keys, std::span<const std::uint32_t> leaf_order);

/// The boxes of all internal nodes, a panel for each depth. The primitives must lie in the unit cube.
std::string draw_boxes(const EightKeys& keys);

/// The sorted keys with their indices, delta between neighbours, and the tree.
std::string draw_duplicates(const EightKeys& keys);

} // namespace figures
