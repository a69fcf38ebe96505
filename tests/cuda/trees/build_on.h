#pragma once

// The same build by every executor, its result on the host, and as the tree that ref/ speaks of.

#include "cuda/trees/node.h"
#include "ref/trees/tree.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cuda_test {

enum class On { serial, threads, interleaved, device };

struct Setup {
    On on;
    int code_bits; // 30 or 63
};

/// For the names of tests: "threads30".
std::string name(const Setup& setup);

struct Built {
    std::vector<fast::Node> nodes;
    std::vector<std::uint32_t> leaf_links;
    std::vector<std::uint32_t> primitives;
    std::vector<std::uint64_t> codes; // sorted
};

/// What the last build of a fast::Lbvh in host memory left.
template <class Tree>
Built copy_of(const Tree& tree)
{
    return {{tree.nodes().begin(), tree.nodes().end()},
            {tree.leaf_links().begin(), tree.leaf_links().end()},
            {tree.primitives().begin(), tree.primitives().end()},
            {tree.codes().begin(), tree.codes().end()}};
}

/// Throws std::invalid_argument that names a box that is none. For the interleaved executor `seed`
/// decides the schedule.
Built build_on(const Setup& setup, std::span<const fast::Aabb> boxes, std::uint64_t seed = 1);

/// The tree as ref/trees/tree.h numbers its nodes. Parents are read from the links, children from the
/// children: that they agree remains to be seen. `root` is the box of a tree that has no internal node.
ref::Tree neutral(const Built& built, const fast::Aabb& root);

/// Exactly the same numbers.
ref::Aabb exactly(const fast::Aabb& box);
std::vector<ref::Aabb> exactly(std::span<const fast::Aabb> boxes);

/// Each coordinate to the nearest float: still no box is empty that was not.
std::vector<fast::Aabb> rounded(std::span<const ref::Aabb> boxes);

} // namespace cuda_test
