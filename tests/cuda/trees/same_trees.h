#pragma once

// Wide trees compared byte by byte.

#include "cuda/trees/wide_tree.h"

#include <cstddef>
#include <cstring>
#include <span>

namespace fast_trees_test {

/// Compares what is defined: the bytes after the children of a node are not.
inline bool same_nodes(std::span<const fast::WideNode> a, std::span<const fast::WideNode> b)
{
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::memcmp(a[i].planes, b[i].planes, sizeof a[i].planes) != 0 ||
            std::memcmp(a[i].children, b[i].children, sizeof a[i].children) != 0)
            return false;
    return true;
}

inline bool same_groups(std::span<const fast::TriangleGroup> a, std::span<const fast::TriangleGroup> b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

} // namespace fast_trees_test
