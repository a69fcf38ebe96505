#pragma once

// One tree over boxes by each builder of both wings, built and checked.

#include "extremes/wing.h"

#include "cuda/trees/aabb.h"
#include "cuda/trees/tree_builder.h"
#include "ref/trees/bvh.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace extremes {

/// A builder of the fast path on a GPU.
struct DeviceBuilder {
    fast::TreeBuilder builder;
    bool operator==(const DeviceBuilder&) const = default;
};

using AnyBuilder = std::variant<ref::Builder, fast::TreeBuilder, DeviceBuilder>;

/// The builder of the fast path, wherever it runs; none for one of the reference.
std::optional<fast::TreeBuilder> fast_builder(const AnyBuilder& builder);

/// A tree that was built: what is needed to judge it.
struct JudgedTree {
    std::vector<std::uint64_t> codes;      // by leaf, in their order; empty if the builder has none
    std::vector<std::uint32_t> primitives; // by leaf
    std::string fault;                     // the first thing that is wrong; empty if it is valid
    int depth = 0;                         // edges from the root to the deepest leaf
};

/// Throws what the builders throw.
JudgedTree judged(ref::Builder builder, std::span<const ref::Aabb> boxes);
JudgedTree judged(fast::TreeBuilder builder, std::span<const fast::Aabb> boxes);
JudgedTree judged(DeviceBuilder builder, std::span<const fast::Aabb> boxes);
/// The same for any builder; the boxes are rounded to the nearest floats for the fast path.
JudgedTree judged(const AnyBuilder& builder, std::span<const ref::Aabb> boxes);

/// The bits of a builder's Morton codes, 30 or 63; 0 if it has none.
int code_bits(const AnyBuilder& builder);

/// The depth that no tree of this builder over n > 0 primitives exceeds. A radix tree: code bits and the
/// bits of an index, code_bits + ceil(log2 n), since the common prefix grows with each edge [Karras
/// 2012]. The sweep: 64 edges and then halves. No bound is known for clusters (hploc.h); there, the
/// most that a traversal of the binary tree can go down, deepest_tree.
int depth_bound(const AnyBuilder& builder, std::size_t n);

/// The number of bytes that building and checking take for each box, those of the boxes included.
double bytes_of_build(const AnyBuilder& builder);

/// The share of neighbours among the leaves that have the same code and different centroids: their order
/// along the curve is lost. `same_centroid(a, b)` of two primitives.
template <class SameCentroid>
double lost_order(const JudgedTree& tree, const SameCentroid& same_centroid)
{
    if (tree.codes.size() < 2) return 0;
    std::size_t lost = 0;
    for (std::size_t i = 1; i < tree.codes.size(); ++i)
        if (tree.codes[i - 1] == tree.codes[i] &&
            !same_centroid(tree.primitives[i - 1], tree.primitives[i]))
            ++lost;
    return static_cast<double>(lost) / static_cast<double>(tree.codes.size() - 1);
}

/// A bound on lost_order for n > 1 primitives whose centroids are independent and in the same cell, two
/// by two, with at most this probability. Of the n (n - 1) / 2 pairs m are expected to be, which is no
/// less than there are neighbours with the same code. The bound is 8 standard deviations of a Poisson
/// distribution and 10 more; and 0 where m < 1e-5.
double lost_order_bound(double n, double probability);

/// All builders as methods, those of a GPU where there is one; run(builder, parameter, random, cases,
/// tally).
template <class Run>
std::vector<Method> tree_methods(const Run& run)
{
    std::vector<std::pair<std::string, AnyBuilder>> builders = {
        {"ref, morton30", ref::Builder::morton30},
        {"ref, morton63", ref::Builder::morton63},
        {"ref, sah", ref::Builder::sah}};
    for (const Wing wing : wings())
        for (const auto& [name, builder] : {std::pair("morton30", fast::TreeBuilder::morton30),
                                            std::pair("morton63", fast::TreeBuilder::morton63),
                                            std::pair("hploc30", fast::TreeBuilder::hploc30),
                                            std::pair("hploc63", fast::TreeBuilder::hploc63)}) {
            if (wing == Wing::host) builders.emplace_back(name_of(wing) + ", " + name, builder);
            if (wing == Wing::cuda)
                builders.emplace_back(name_of(wing) + ", " + name, DeviceBuilder{builder});
        }
    std::vector<Method> methods;
    for (const auto& [name, builder] : builders) {
        const bool is_ref = std::holds_alternative<ref::Builder>(builder);
        methods.push_back(
            {name, is_ref ? Format::binary64 : Format::binary32,
             [builder = builder, run](double parameter, Random& random, int cases, Tally& tally) {
                 run(builder, parameter, random, cases, tally);
             }});
    }
    return methods;
}

} // namespace extremes
