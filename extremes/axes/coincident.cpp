// Primitives whose centroids coincide: their Morton codes are equal, whatever the number of bits.

#include "extremes/axes/axes.h"
#include "extremes/trees/tree_builds.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace extremes {

namespace {

constexpr std::size_t boxes_of_coincident = std::size_t{1} << 14;

/// Boxes in the unit cube, of which `share` have one centroid. Of these some are equal, others are
/// nested.
std::vector<ref::Aabb> partly_coincident(double share, Random& random)
{
    const auto point = [&] {
        return scenes::Vec3(random.uniform(), random.uniform(), random.uniform());
    };
    const scenes::Vec3 common = point();
    const bool nested = random.below(2) == 0;
    const auto count = static_cast<std::size_t>(std::lround(share * boxes_of_coincident));
    std::vector<ref::Aabb> boxes(boxes_of_coincident);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const scenes::Vec3 middle = i < count ? common : point();
        const double size = nested ? random.log_between(1e-4, 1e-1) : 1e-3;
        const scenes::Vec3 half = nested ? size * point() : scenes::Vec3(size);
        boxes[i] = {middle - half, middle + half};
    }
    for (std::size_t i = boxes.size() - 1; i > 0; --i) std::swap(boxes[i], boxes[random.below(i + 1)]);
    return boxes;
}

void run_coincident(const AnyBuilder& builder, double share, Random& random, int cases, Tally& tally)
{
    for (int i = 0; i < cases; ++i) {
        const std::vector<ref::Aabb> boxes = partly_coincident(share, random);
        const JudgedTree tree = judged(builder, boxes);
        if (tree.fault.empty())
            tally.add(
                std::max(0.0, static_cast<double>(tree.depth) / depth_bound(builder, boxes.size()) - 1));
        else
            tally.add(Failure::wrong_order);
    }
}

} // namespace

Axis coincident_axis()
{
    Axis axis;
    axis.number = 12;
    axis.name = "coincident";
    axis.title = "Coincident primitives";
    axis.parameter = "share of primitives with the same centroid";
    axis.about =
        "A case is a tree over 16,384 boxes, of which a share has the same centroid: these are equal "
        "boxes, or "
        "boxes of many sizes around one point. The error is how much deeper the tree is than its bound, "
        "relative to the bound. That is code bits + ceil(log2 n) for radix trees, 64 + ceil(log2 n) for "
        "the "
        "sweep, and the 92 levels of a traversal for clusters. A tree that is not valid is a failure.";
    axis.ordinary = 0;
    axis.logarithmic = false;
    for (int i = 0; i <= 10; ++i) axis.values.push_back(i / 10.0);
    axis.most_cases = 20;
    axis.methods = tree_methods(run_coincident);
    // Bounds of 0: theorems (depth_bound). None is known for clusters.
    for (const char* method : {"ref, morton30", "ref, morton63", "host, morton30", "host, morton63"})
        axis.limits.push_back(
            {method, 1.0, [](double) { return 0.0; }, no_failure, Failure::inaccurate,
             "equal codes are told apart by the bits of the leaf's number, ceil(log2 n) of them"});
    axis.limits.push_back({"ref, sah", 1.0, [](double) { return 0.0; }, no_failure, Failure::inaccurate,
                           "from a depth of 64 on, nodes are split in halves"});
    axis.derivation = "the common prefix of the keys of a node is longer than that of its parent, and a "
                      "key has the bits of "
                      "its code and $\\lceil \\log_2 n \\rceil$ bits of its number: no path from the "
                      "root has more edges. "
                      "The bound on the error is 0.";
    return axis;
}

} // namespace extremes
