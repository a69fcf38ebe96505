#pragma once

// The trees that the surfaces of a scene can have (surfaces.h). None changes a hit: at equal distances
// the lowest primitive number decides.

#include <array>
#include <string_view>

namespace fast {

/// `morton..`: the radix tree over Morton codes of so many bits (lbvh.h). `hploc..`: clustered over the
/// same codes (hploc.h); where that tree is too deep for a traversal, the radix tree.
enum class TreeBuilder { morton30, morton63, hploc30, hploc63 };

/// All of them.
inline constexpr std::array tree_builders = {TreeBuilder::morton30, TreeBuilder::morton63,
                                             TreeBuilder::hploc30, TreeBuilder::hploc63};

/// Rays visit the fewest groups of triangles (docs/cuda-trees.md).
inline constexpr TreeBuilder default_tree_builder = TreeBuilder::hploc63;

/// The name of the enumerator.
constexpr std::string_view name_of(TreeBuilder builder)
{
    switch (builder) {
    case TreeBuilder::morton30:
        return "morton30";
    case TreeBuilder::morton63:
        return "morton63";
    case TreeBuilder::hploc30:
        return "hploc30";
    case TreeBuilder::hploc63:
        break;
    }
    return "hploc63";
}

} // namespace fast
