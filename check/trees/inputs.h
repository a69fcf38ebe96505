#pragma once

// Sets of boxes that builders of trees are known to fail on, for tests of a builder.

#include "ref/trees/aabb.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace check {

enum class InputKind {
    empty,      // no box at all: may be rejected
    uniform,    // centres uniform in a cube, sizes of all orders of magnitude, some boxes without volume
    grid,       // unit cubes in rows: all coordinates are small integers, with many ties
    clustered,  // three clusters, each far smaller than the distances between them
    duplicated, // about half of the boxes are copies of others: equal Morton codes
    coincident, // all boxes are the same one
    concentric, // different boxes with one common centre: all centroids are equal
    flat,       // all centres in one plane: an axis of the centroid box has no extent
    collinear,  // all centres on one line parallel to an axis: two such axes
    geometric,  // centres at 1/2, 1/4, 1/8, ...: the deepest trees of builders that split space
    giant,      // one box around all others, a million times their size
    huge,       // coordinates up to 1e30: a product of two exceeds the range of floats
    tiny,       // coordinates of 1e-30: a product of two is 0 in floats
    denormal,   // coordinates of a few times the smallest positive number
    mixed,      // boxes of all scales from 1e-30 to 1e30
    infinite,   // one coordinate is infinite: may be rejected
    nan,        // one coordinate is NaN: must be rejected
};

inline constexpr std::array input_kinds = {
    InputKind::empty,      InputKind::uniform,    InputKind::grid,       InputKind::clustered,
    InputKind::duplicated, InputKind::coincident, InputKind::concentric, InputKind::flat,
    InputKind::collinear,  InputKind::geometric,  InputKind::giant,      InputKind::huge,
    InputKind::tiny,       InputKind::denormal,   InputKind::mixed,      InputKind::infinite,
    InputKind::nan};

/// "uniform"
std::string name(InputKind kind);

/// `n` boxes of this kind (none of `empty`), the same ones for the same seed. All coordinates are floats
/// if `single_precision`. Lower ends are never above upper ends; only `infinite` and `nan` have a
/// coordinate that is not finite, in one box (none if n = 0).
std::vector<ref::Aabb> input_boxes(InputKind kind, std::size_t n, std::uint64_t seed,
                                   bool single_precision = true);

} // namespace check
