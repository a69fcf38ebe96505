// A tree over very many primitives.

#include "extremes/axes/axes.h"
#include "extremes/refusal.h"
#include "extremes/trees/free_memory.h"
#include "extremes/trees/tree_builds.h"

#include "cuda/parallel/executor.h"
#include "cuda/trees/lbvh.h"
#include "scenes/short_number.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace extremes {

namespace {

constexpr double most_boxes_of_sweep = 0x1p22; // takes half a minute; four times as many, two

/// Boxes in the unit cube, about as large as the distance between neighbours.
std::vector<fast::Aabb> many_boxes(std::uint32_t n, Random& random)
{
    const auto size = static_cast<float>(1 / std::cbrt(static_cast<double>(n)));
    std::vector<fast::Aabb> boxes(n);
    for (fast::Aabb& box : boxes)
        for (int axis = 0; axis < 3; ++axis) {
            const std::uint64_t bits = random.bits();
            box.lower[axis] = static_cast<float>(bits >> 40) * 0x1p-24f;
            box.upper[axis] = box.lower[axis] + size * static_cast<float>(bits & 0xff'ffff) * 0x1p-24f;
        }
    return boxes;
}

std::vector<ref::Aabb> in_doubles(std::span<const fast::Aabb> boxes)
{
    std::vector<ref::Aabb> exact;
    exact.reserve(boxes.size());
    for (const fast::Aabb& box : boxes)
        exact.push_back({scenes::Vec3(box.lower), scenes::Vec3(box.upper)});
    return exact;
}

/// Throws, with a message, what the fast path throws for too many primitives.
void refuse_size(const AnyBuilder& builder, double n)
{
    if (std::holds_alternative<ref::Builder>(builder) || n <= fast::most_primitives) return;
    fast::HostMemory memory;
    const fast::Lbvh<std::uint64_t> refused(memory, fast::SerialExecutor{},
                                            static_cast<std::uint32_t>(std::min(n, 0x1p32 - 1)));
}

/// Why no tree of this size is built; empty if one can be.
std::string reason_to_leave_out(const AnyBuilder& builder, double n)
{
    const auto gib = [](double bytes) { return scenes::short_number(bytes * 0x1p-30) + " GiB"; };
    const double needed = n * bytes_of_build(builder);
    if (const double free = free_memory(); needed > 0.9 * free) // others need some meanwhile
        return "needs " + gib(needed) + " of memory, and " + gib(free) + " are free";
    if (builder == AnyBuilder(ref::Builder::sah) && n > most_boxes_of_sweep)
        return "the sweep takes minutes";
    return "";
}

template <class Builder, class Box>
void judge_size(Builder builder, std::span<const Box> boxes, Tally& tally)
{
    const JudgedTree tree = judged(builder, boxes);
    if (!tree.fault.empty() || tree.depth > depth_bound(builder, boxes.size())) {
        tally.add(Failure::wrong_order);
        return;
    }
    const auto twice_middle = [&](std::uint32_t i) { // exact for boxes of floats
        return scenes::Vec3(boxes[i].lower) + scenes::Vec3(boxes[i].upper);
    };
    tally.add(lost_order(
        tree, [&](std::uint32_t a, std::uint32_t b) { return twice_middle(a) == twice_middle(b); }));
}

void run_tree_size(const AnyBuilder& builder, double parameter, Random& random, int cases, Tally& tally)
{
    for (int i = 0; i < cases; ++i) {
        const bool accepted = unless_refused(tally, 1, [&] { refuse_size(builder, parameter); });
        if (!accepted) continue;
        if (const std::string reason = reason_to_leave_out(builder, parameter); !reason.empty()) {
            tally.leave_out(reason);
            continue;
        }
        const auto n = static_cast<std::uint32_t>(parameter);
        if (const auto* host = std::get_if<fast::TreeBuilder>(&builder))
            judge_size<fast::TreeBuilder, fast::Aabb>(*host, many_boxes(n, random), tally);
        else if (const auto* device = std::get_if<DeviceBuilder>(&builder))
            judge_size<DeviceBuilder, fast::Aabb>(*device, many_boxes(n, random), tally);
        else
            judge_size<ref::Builder, ref::Aabb>(std::get<ref::Builder>(builder),
                                                in_doubles(many_boxes(n, random)), tally);
    }
}

// Corners are uniform on [0, 1), and sizes are added to them: the density of a centroid is at most 1
// along each axis, and the grid at most 1 + s / 2 wide. In single precision (u = 2^-24) a centroid is
// rounded by u, its difference from the end of the grid and the quotient by u: the ends of cells are
// moved by 3 u 2^b of their width w, and two centroids are in one cell with a probability of ((1 + 6 u
// 2^b) w)^3.
double lost_by_size(double n, int bits, Format format)
{
    const double cells = std::ldexp(1.0, bits);
    const double u = unit_roundoff(format);
    const double w = (1 + 6 * u * cells) * (1 + 0.5 / std::cbrt(n)) / cells;
    return lost_order_bound(n, w * w * w);
}

} // namespace

Axis tree_size_axis()
{
    Axis axis;
    axis.number = 12;
    axis.name = "tree-size";
    axis.title = "Number of primitives of a tree";
    axis.parameter = "number of primitives";
    axis.about =
        "A case is one tree over random boxes in the unit cube. The error is the share of "
        "neighbours, in the order of the leaves, that have the same code though their centroids "
        "differ: their order along the curve is lost. The sweep has no codes and no error. A "
        "tree that is not valid or deeper than its bound is a failure. More than 2^29 primitives "
        "are refused by the fast path. A tree for which there is not enough memory is not built, "
        "and neither is a sweep over more than 2^22 boxes, which takes minutes: the page says so "
        "at these points.";
    axis.ordinary = 1024;
    axis.logarithmic = true;
    for (int k = 0; k <= 26; k += 2) axis.values.push_back(std::ldexp(1.0, k));
    axis.values.push_back(0x1p30);
    axis.most_cases = 1;
    axis.methods = tree_methods(run_tree_size);
    const std::string walked = "nothing fails up to here, the largest tree that is walked";
    const std::string in_cells = "of so many random points 1% share a cell of the grid with their "
                                 "neighbour; the tree stays valid";
    const auto limit = [&](const std::string& method, int bits, Format format) {
        const auto bound = [=](double n) { return lost_by_size(n, bits, format); };
        Limit of{method, 0x1p26, bound, no_failure, Failure::inaccurate, walked, 0x1p18};
        if (format == Format::binary32) {
            of.beyond = 0x1p30;
            of.failure = Failure::refused;
            of.because += "; more than 2^29 primitives are refused";
        }
        if (bits == 10) {
            of.safe = 0x1p24;
            of.beyond = 0x1p26;
            of.failure = Failure::inaccurate;
            of.because = in_cells;
            of.beyond_takes_long = true;
        }
        axis.limits.push_back(of);
    };
    limit("ref, morton30", 10, Format::binary64);
    limit("ref, morton63", 21, Format::binary64);
    limit("host, morton30", 10, Format::binary32);
    limit("host, morton63", 21, Format::binary32);
    limit("host, hploc30", 10, Format::binary32);
    limit("host, hploc63", 21, Format::binary32);
    axis.limits.push_back({"ref, sah", 0x1p22, [](double) { return 0.0; }, no_failure,
                           Failure::inaccurate, walked + " by the sweep", 0x1p15});
    axis.derivation = "$n$ random centroids in $N = 2^{30}$ cells share one with $n (n - 1) / (2 N)$ "
                      "pairs: a share of $n / 2^{31}$ of all neighbours, and 1% from 21 million "
                      "primitives on. In $2^{63}$ cells the share stays below $10^{-9}$ up to the "
                      "most primitives that can be numbered.";
    return axis;
}

} // namespace extremes
