#pragma once

// The figure of a radix tree as in [Karras 2012]: sorted keys with their bits, and the range and the
// split of every internal node.

#include "ref/trees/radix_tree.h"

#include <span>
#include <string>

namespace cli {

/// More keys do not fit a page.
constexpr std::size_t most_keys_in_figure = 64;

/// An SVG document for the radix tree over sorted `codes` of `code_bits` bits; `primitives`: the
/// primitive of each code. Only the leading bits that differ between codes are drawn.
std::string radix_tree_figure(ref::Codes codes, std::span<const std::uint32_t> primitives,
                              int code_bits);

} // namespace cli
