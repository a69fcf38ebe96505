#pragma once

// The stack of a traversal.

#include "cuda/trees/wide_node.h"

#include <bit>
#include <cstdint>

namespace fast {

/// Nodes and leaves that a ray has yet to visit, each with the t >= 0 at which the ray enters its box.
class TraversalStack {
public:
    /// The bits of floats >= 0 sort like the floats, so an element is compared as one number.
    HD static std::uint64_t element(std::uint32_t child, float entry)
    {
        return std::uint64_t{std::bit_cast<std::uint32_t>(entry)} << 32 | child;
    }
    HD void push(std::uint64_t element) { elements_[height_++] = element; }
    /// Pushes it `times` times, 0 or 1.
    HD void push(std::uint64_t element, int times)
    {
        elements_[height_] = element;
        height_ += times;
    }
    /// Pushes it, above or below the last element, of which there is one.
    HD void push_in_order(std::uint64_t element)
    {
        const std::uint64_t last = elements_[height_ - 1];
        const std::uint64_t nearer = element < last ? element : last;
        elements_[height_ - 1] = element ^ last ^ nearer;
        elements_[height_++] = nearer;
    }
    /// Pops until an element has entry <= limit, and returns that one in `child`; false if there is
    /// none. An entry equal to the limit counts: the box may hold a primitive of lower number at the
    /// same t.
    HD bool pop(float limit, std::uint32_t& child)
    {
        while (height_ > 0) {
            const std::uint64_t element = elements_[--height_];
            child = static_cast<std::uint32_t>(element);
            if (std::bit_cast<float>(static_cast<std::uint32_t>(element >> 32)) <= limit) return true;
        }
        return false;
    }

    /// One step down a wide tree leaves all children but one on the stack. It may lead to a child that
    /// is only one level deeper in the binary tree, because its siblings were opened.
    static constexpr int most = (most_children - 1) * deepest_tree + most_children;

private:
    std::uint64_t elements_[most];
    int height_ = 0;
};

} // namespace fast
