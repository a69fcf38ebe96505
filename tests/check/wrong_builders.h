#pragma once

// A small builder, right or with one of the defects that builders have had.

#include "check/trees/neutral_tree.h"

#include <array>
#include <span>
#include <string>

namespace check_test {

/// A defect, and where it happened.
enum class Defect {
    none,
    shared_child,   // three equal keys, no tie-break: a node with two parents (DataTransferKit #373)
    offset_twice,   // the offset of the split is added twice (recast4j #315)
    tiny_input,     // an endless loop for two primitives (Genesis #1766)
    one_primitive,  // a crash (Ignis #3, tinybvh #122)
    flat_axis,      // 0 / 0 where centroids have no extent (EBGeometry #98)
    accepts_nan,    // NaN is not rejected (ifc-lite #3561)
    short_count,    // a leaf's count has 8 bits here, 16 in pbrt-v3 #182
    leaf_goes_on,   // no return after making a leaf (pbrt-v3 #47)
    lost_key,       // the sort loses the keys of its last, partial block (rocPRIM #775)
    partial_block,  // the scene's box lacks the last, partial block (warp #1863)
    last_leaf,      // a grid of n - 1 threads: the last leaf has no box (MinimumLBVH)
    chain,          // no tie-break at all: equal keys become a chain (MinimumLBVH)
    stale_box,      // the box of the child that arrived first (axom #307)
    scene_box,      // the scene's box everywhere (tinybvh #149)
    writes_no_tree, // success without a file
    writes_garbage, // a file of another kind
};

inline constexpr std::array defect_names = {
    "none",        "shared_child", "offset_twice", "tiny_input",     "one_primitive", "flat_axis",
    "accepts_nan", "short_count",  "leaf_goes_on", "lost_key",       "partial_block", "last_leaf",
    "chain",       "stale_box",    "scene_box",    "writes_no_tree", "writes_garbage"};

/// Throws std::invalid_argument for illegal boxes. `tiny_input` and `one_primitive` throw
/// std::logic_error where a program would hang or crash.
check::NeutralTree build(Defect defect, std::span<const ref::Aabb> boxes);

} // namespace check_test
