#pragma once

// A tree of anybody's builder.

#include "ref/trees/tree.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace check {

/// A tree of boxes over primitives, with any numbering of its nodes and any number of primitives in a
/// leaf: what the files of docs/own-code.md hold. Nothing about it need be valid.
struct NeutralTree {
    static constexpr std::int64_t none = -1;

    std::size_t width = 2; // the most children of a node, at least 2
    /// `width` + 2 numbers per node: its children (`none` where there is no further one), its first slot
    /// in `primitives`, and the number of its slots. A leaf has no child, an internal node no slot.
    std::vector<std::int64_t> nodes;
    std::vector<ref::Aabb> boxes;         // one per node
    std::vector<std::int64_t> primitives; // the slots: numbers of primitives
    std::vector<std::int64_t> parents;    // one per node, `none` for the root; or empty
    std::optional<std::int64_t> root;     // else it is the node that is nobody's child
    /// Whether the boxes were rounded to floats: a box is then tight if no box of floats is tighter.
    bool single_precision = false;

    [[nodiscard]] std::size_t size() const { return nodes.size() / (width + 2); }
    [[nodiscard]] std::span<const std::int64_t> children(std::size_t node) const
    {
        return std::span(nodes).subspan(node * (width + 2), width);
    }
    [[nodiscard]] std::int64_t first_slot(std::size_t node) const
    {
        return nodes[node * (width + 2) + width];
    }
    [[nodiscard]] std::int64_t slot_count(std::size_t node) const
    {
        return nodes[node * (width + 2) + width + 1];
    }
    [[nodiscard]] bool is_leaf(std::size_t node) const
    {
        for (const std::int64_t child : children(node))
            if (child != none) return false;
        return true;
    }
};

/// Our own tree in this form, with its parents.
NeutralTree neutral(const ref::Tree& tree);

} // namespace check
