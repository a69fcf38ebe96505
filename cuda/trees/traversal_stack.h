#pragma once

// The stack of a traversal.

#include "cuda/trees/node.h"

#include <cstdint>

namespace fast {

/// Nodes and leaves that a ray has yet to visit, each with the t at which the ray enters its box.
class TraversalStack {
public:
    HD void push(std::uint32_t child, float entry)
    {
        children_[height_] = child;
        entries_[height_] = entry;
        ++height_;
    }
    /// The same without a branch: pushes only if `wanted`.
    HD void push_if(bool wanted, std::uint32_t child, float entry)
    {
        children_[height_] = child;
        entries_[height_] = entry;
        height_ += wanted ? 1 : 0;
    }
    /// Pops until an element has entry <= limit, and returns that one in `child`; false if there is
    /// none. An entry equal to the limit counts: the box may hold a primitive of lower number at the
    /// same t.
    HD bool pop(float limit, std::uint32_t& child)
    {
        while (height_ > 0) {
            --height_;
            child = children_[height_];
            if (entries_[height_] <= limit) return true;
        }
        return false;
    }

private:
    // One step down a binary tree leaves one child on the stack. One step down a wide tree leaves at
    // most three, and may lead to a child that is only one level deeper in the binary tree, because its
    // sibling was opened twice.
    static constexpr int most = 3 * deepest_tree + 4;
    std::uint32_t children_[most];
    float entries_[most];
    int height_ = 0;
};

} // namespace fast
