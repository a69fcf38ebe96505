#include "extremes/trees/tree_builds.h"

#include "extremes/trees/check_binary_tree.h"

#include "cuda/launch/device_lbvh.h"
#include "cuda/parallel/executor.h"
#include "cuda/trees/hploc.h"
#include "cuda/trees/lbvh.h"
#include "ref/trees/is_valid_tree.h"
#include "ref/trees/quality.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

namespace extremes {

namespace {

bool clusters(fast::TreeBuilder builder)
{
    return builder == fast::TreeBuilder::hploc30 || builder == fast::TreeBuilder::hploc63;
}

/// `codes` by leaf. `leaves_in_order`: as a radix tree has them.
JudgedTree judged_binary(const BinaryTree& tree, bool leaves_in_order, std::vector<std::uint64_t> codes)
{
    const CheckedTree result = checked(tree, leaves_in_order);
    JudgedTree judged{
        std::move(codes), {tree.primitives.begin(), tree.primitives.end()}, result.fault, result.depth};
    if (judged.fault.empty() && !std::ranges::is_sorted(judged.codes))
        judged.fault = "codes not in order";
    return judged;
}

template <class Code>
JudgedTree judged_fast(std::span<const fast::Aabb> boxes, bool clustered)
{
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    const auto n = static_cast<std::uint32_t>(boxes.size());
    fast::Lbvh<Code> sorted(memory, executor, n);
    std::optional<fast::Hploc> merged;
    if (clustered) merged.emplace(memory, n);
    sorted.build(executor, boxes);
    fast::throw_if_rejected(sorted.first_rejected(), boxes);
    BinaryTree tree{std::as_const(sorted).nodes(), sorted.leaf_links(), sorted.primitives(), boxes};
    if (clustered) {
        merged->build(executor, boxes, sorted.order());
        tree.nodes = std::as_const(*merged).nodes();
        tree.leaf_links = merged->leaf_links();
    }
    JudgedTree judged = judged_binary(tree, !clustered, {sorted.codes().begin(), sorted.codes().end()});
    if (judged.fault.empty() && clustered &&
        merged->height() != static_cast<std::uint32_t>(judged.depth))
        judged.fault = "a wrong height";
    return judged;
}

} // namespace

JudgedTree judged(ref::Builder builder, std::span<const ref::Aabb> boxes)
{
    const ref::Tree tree = ref::build(boxes, builder);
    JudgedTree result;
    result.primitives = tree.primitives;
    std::vector<std::string> faults = ref::is_valid_tree(tree, boxes);
    if (faults.empty()) result.depth = ref::quality(tree).depth;
    if (const int bits = code_bits(builder); bits > 0) {
        const std::vector<std::uint64_t> codes = ref::morton_codes(boxes, bits / 3);
        result.codes.reserve(codes.size());
        for (const std::uint32_t primitive : tree.primitives) result.codes.push_back(codes[primitive]);
        if (faults.empty() && !std::ranges::is_sorted(result.codes))
            faults.emplace_back("codes not in order");
        if (faults.empty()) faults = ref::is_valid_radix_tree(tree, result.codes);
    }
    if (!faults.empty()) result.fault = faults[0];
    return result;
}

JudgedTree judged(fast::TreeBuilder builder, std::span<const fast::Aabb> boxes)
{
    return code_bits(builder) == 30 ? judged_fast<std::uint32_t>(boxes, clusters(builder))
                                    : judged_fast<std::uint64_t>(boxes, clusters(builder));
}

JudgedTree judged(DeviceBuilder builder, std::span<const fast::Aabb> boxes)
{
    fast::DeviceLbvh device(static_cast<std::uint32_t>(boxes.size()), code_bits(builder));
    device.build(boxes);
    fast::BuiltTree tree = device.download();
    std::vector<std::uint64_t> codes = std::move(tree.codes);
    const bool clustered = clusters(builder.builder);
    if (clustered) tree = device.download_clustered();
    return judged_binary({tree.nodes, tree.leaf_links, tree.primitives, boxes}, !clustered,
                         std::move(codes));
}

std::optional<fast::TreeBuilder> fast_builder(const AnyBuilder& builder)
{
    if (const auto* device = std::get_if<DeviceBuilder>(&builder)) return device->builder;
    const auto* host = std::get_if<fast::TreeBuilder>(&builder);
    return host != nullptr ? std::optional(*host) : std::nullopt;
}

JudgedTree judged(const AnyBuilder& builder, std::span<const ref::Aabb> boxes)
{
    if (const auto* reference = std::get_if<ref::Builder>(&builder)) return judged(*reference, boxes);
    std::vector<fast::Aabb> rounded;
    rounded.reserve(boxes.size());
    for (const ref::Aabb& box : boxes) rounded.push_back({fast::Vec3(box.lower), fast::Vec3(box.upper)});
    if (const auto* device = std::get_if<DeviceBuilder>(&builder)) return judged(*device, rounded);
    return judged(std::get<fast::TreeBuilder>(builder), rounded);
}

int code_bits(const AnyBuilder& builder)
{
    if (const auto* reference = std::get_if<ref::Builder>(&builder)) {
        if (*reference == ref::Builder::morton30) return 30;
        return *reference == ref::Builder::morton63 ? 63 : 0;
    }
    const fast::TreeBuilder of_floats = *fast_builder(builder);
    return of_floats == fast::TreeBuilder::morton30 || of_floats == fast::TreeBuilder::hploc30 ? 30 : 63;
}

int depth_bound(const AnyBuilder& builder, std::size_t n)
{
    const auto index_bits = static_cast<int>(std::bit_width(n - 1));
    if (const auto of_floats = fast_builder(builder); of_floats && clusters(*of_floats))
        return fast::deepest_tree;
    const int bits = code_bits(builder);
    return (bits > 0 ? bits : 64) + index_bits;
}

double lost_order_bound(double n, double probability)
{
    const double m = 0.5 * n * (n - 1) * probability;
    if (m < 1e-5) return 0;
    return std::min(1.0, (m + 8 * std::sqrt(m) + 10) / (n - 1));
}

double bytes_of_build(const AnyBuilder& builder)
{
    if (const auto* reference = std::get_if<ref::Builder>(&builder)) {
        // Boxes 48; nodes 24, their boxes 96, primitives and first leaves 8; to check: ranges 16, the
        // order of nodes 8. The radix sort has 24 and the codes 8 more; the sweep three lists 12,
        // costs 8.
        return 48 + 24 + 96 + 8 + (*reference == ref::Builder::sah ? 24 + 20 : 24 + 32);
    }
    // Boxes 24; nodes 64, links 4, two of codes and of primitives; the copies of both at the end.
    // Clusters have nodes and links again, two lists 16, and 36 each.
    const double codes = code_bits(builder) == 30 ? 4 : 8;
    return 24 + 68 + 2 * (codes + 4) + 12 + (clusters(*fast_builder(builder)) ? 68 + 16 + 36 : 0);
}

} // namespace extremes
