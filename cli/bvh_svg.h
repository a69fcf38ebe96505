#pragma once

// The figure by which Karras' construction is taught, drawn from data: sorted keys with their bits, the
// range of every internal node and its split.

#include "ref/trees/radix_tree.h"

#include <span>
#include <string>

namespace cli {

/// More keys than this do not fit a page.
constexpr std::size_t most_keys_in_figure = 64;

/// An SVG document for the radix tree over sorted `codes` of `code_bits` bits; `primitives` says to
/// which primitive each belongs. Only as many bits are shown as are needed to tell different codes
/// apart.
std::string radix_tree_figure(ref::Codes codes, std::span<const std::uint32_t> primitives,
                              int code_bits);

} // namespace cli
