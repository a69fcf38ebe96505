#pragma once

// The same build by every executor, its result on the host, and the result as a tree of ref/.

#include "cuda/trees/node.h"
#include "ref/trees/tree.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace fast_trees_test {

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

/// The result of the last build of a fast::Lbvh in host memory.
template <class Tree>
Built copy_of(const Tree& tree)
{
    return {{tree.nodes().begin(), tree.nodes().end()},
            {tree.leaf_links().begin(), tree.leaf_links().end()},
            {tree.primitives().begin(), tree.primitives().end()},
            {tree.codes().begin(), tree.codes().end()}};
}

/// Throws std::invalid_argument that names a box that is empty or not finite. For the interleaved
/// executor `seed` decides the schedule.
Built build_on(const Setup& setup, std::span<const fast::Aabb> boxes, std::uint64_t seed = 1);

/// The tree with nodes numbered as in ref/trees/tree.h. Parents are read from the links, and children
/// from the children, so that a test can compare them. `root` is the box of a tree without internal
/// nodes.
ref::Tree neutral(const Built& built, const fast::Aabb& root);

/// The box with exactly the same numbers.
ref::Aabb exactly(const fast::Aabb& box);
std::vector<ref::Aabb> exactly(std::span<const fast::Aabb> boxes);

/// The boxes with each coordinate rounded to the nearest float: no box becomes empty.
std::vector<fast::Aabb> rounded(std::span<const ref::Aabb> boxes);

} // namespace fast_trees_test
