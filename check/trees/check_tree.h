#pragma once

// Checks a tree of anybody's builder, property by property.

#include "check/trees/neutral_tree.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace check {

/// A property of a tree, whether the tree has it, and the first counter-example if not.
struct Property {
    enum class Verdict { holds, fails, not_checked };

    std::string name;    // "one-parent"
    std::string meaning; // "each node but the root is the child of exactly one node"
    Verdict verdict = Verdict::holds;
    std::size_t violations = 0;
    std::string example;                   // the first violation, with its numbers
    std::int64_t node = NeutralTree::none; // of the first violation, `none` if it has none
    std::int64_t primitive = NeutralTree::none;
};

/// The expected cost of a ray by the surface area heuristic, as in ref/trees/quality.h: of the tree, and
/// of our own trees over the same primitives. Not finite where an area exceeds the range of a double.
struct SahCosts {
    double tree;
    double lbvh; // radix tree over Morton codes of 63 bits
    double sah;  // full sweep of the surface area heuristic, one primitive per leaf
};

struct TreeReport {
    std::size_t primitives = 0;
    std::size_t nodes = 0;
    std::size_t leaves = 0;
    std::vector<Property> properties;

    /// Of a tree whose structure is sound (every property but those of the boxes), else none.
    struct Shape {
        std::int64_t root; // `none` for a tree without nodes
        std::size_t depth; // edges from the root to the deepest leaf
        double mean_leaf_depth;
        std::size_t smallest_leaf, largest_leaf; // primitives
        /// Whether the leaves' primitives, from left to right, are sorted by the Morton codes of
        /// ref/trees/morton.h, computed in double precision.
        bool in_order_of_30_bits, in_order_of_63_bits;
    };
    std::optional<Shape> shape;
    std::optional<SahCosts> costs; // of a tree with sound structure and boxes, if they were asked for

    /// Whether no property fails.
    [[nodiscard]] bool passes() const;
    /// The first property that fails; null if none does.
    [[nodiscard]] const Property* first_failure() const;
};

/// What to check besides the properties that every tree must have.
struct TreeChecks {
    bool tight = true;                    // no box may be larger than necessary
    std::optional<std::size_t> max_depth; // edges from the root to the deepest leaf
    int morton_bits = 0;                  // the leaves must be in the order of these codes: 30, 63, or 0
    bool costs = false;                   // build our own trees and compare SAH costs
};

/// Checks `tree` over these primitives, whose boxes must not be empty nor contain NaN. The properties,
/// by name: sizes, nodes, indices, one-parent, one-root, reachable, parents (if the tree has them),
/// primitives, contain, tight, and those of `checks`. All comparisons are exact. Any tree is safe: every
/// index is checked before it is followed, cycles end, and depth needs no stack. A tree over no
/// primitives has no node, or one leaf without slots.
TreeReport check_tree(const NeutralTree& tree, std::span<const ref::Aabb> primitives,
                      const TreeChecks& checks = {});

} // namespace check
