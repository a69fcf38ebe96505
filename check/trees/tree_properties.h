#pragma once

// The parts of check_tree: one function per property, or per group of properties that share their work.

#include "check/trees/check_tree.h"

#include <functional>
#include <utility>

namespace check {

/// Counts the violations of one property; the first becomes its example.
class Findings {
public:
    Findings(std::string name, std::string meaning)
    {
        property_.name = std::move(name);
        property_.meaning = std::move(meaning);
    }
    /// One more violation. `text` is called for the first only.
    void add(const std::function<std::string()>& text, std::int64_t node = NeutralTree::none,
             std::int64_t primitive = NeutralTree::none)
    {
        if (property_.violations++ > 0) return;
        property_.verdict = Property::Verdict::fails;
        property_.example = text();
        property_.node = node;
        property_.primitive = primitive;
    }
    [[nodiscard]] Property take() { return std::move(property_); }

private:
    Property property_;
};

/// "node 7"
std::string node_text(std::int64_t node);

/// Whether `child` is a node of the tree.
inline bool is_node(const NeutralTree& tree, std::int64_t child)
{
    return child >= 0 && static_cast<std::size_t>(child) < tree.size();
}

/// The slots of a leaf that exist: none if its numbers are out of range.
std::span<const std::int64_t> slots_of(const NeutralTree& tree, std::size_t node);

Property check_sizes(const NeutralTree& tree);

// The tree must pass check_sizes for these. They pass over indices that are out of range.
Property check_nodes(const NeutralTree& tree, std::size_t primitives);
Property check_indices(const NeutralTree& tree, std::size_t primitives);
Property check_leaves(const NeutralTree& tree, std::size_t primitives);
/// one-parent, one-root, reachable, and parents if the tree has them. Sets `root`; `none` if there is
/// not exactly one.
std::vector<Property> check_links(const NeutralTree& tree, std::size_t primitives, std::int64_t& root);
Property check_contain(const NeutralTree& tree, std::span<const ref::Aabb> primitives);
Property check_tight(const NeutralTree& tree, std::span<const ref::Aabb> primitives);

} // namespace check
