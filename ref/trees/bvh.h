#pragma once

// Builds a tree over boxes, with any of the builders.

#include "ref/trees/tree.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace ref {

enum class Builder {
    morton30, // radix tree over Morton codes of 10 bits per axis [Karras 2012]
    morton63, // the same with 21 bits per axis
    sah,      // full sweep of the surface area heuristic, one primitive per leaf
    sah_leaf, // the same with several primitives per leaf where that is expected to be cheaper
};

/// A tree over more primitives has more nodes than 32 bits can number.
constexpr std::size_t most_primitives = std::size_t{1} << 31;

/// How to build a tree. A Builder alone is one, too: that of its defaults.
struct BuildOptions {
    Builder builder;
    std::size_t max_leaf_size; // of sah_leaf: the most primitives of a leaf, at least 1

    BuildOptions(Builder of, std::size_t leaf_size = 8) : builder(of), max_leaf_size(leaf_size) {}
};

/// The box of every primitive, in the order of the primitive numbers. The boxes of spheres are rounded
/// outwards. Throws std::invalid_argument that names the first primitive with a coordinate that is NaN
/// or infinite.
std::vector<Aabb> primitive_bounds(const scenes::Scene& scene);

/// The Morton codes of the boxes' centroids in the grid that spans all centroids.
std::vector<std::uint64_t> morton_codes(std::span<const Aabb> boxes, int bits_per_axis);

/// A tree over any number of boxes, also over none. Flat, coincident and point-like boxes are legal.
/// Throws std::invalid_argument that names the first box that is empty or has a coordinate that is NaN
/// or infinite, for leaves of no primitive, and for more than most_primitives.
Tree build(std::span<const Aabb> boxes, const BuildOptions& options);

} // namespace ref
