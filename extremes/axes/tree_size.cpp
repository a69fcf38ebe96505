// A tree over very many primitives.

#include "extremes/axes/axes.h"
#include "extremes/trees/free_memory.h"
#include "extremes/trees/tree_builds.h"

#include "cuda/parallel/executor.h"
#include "cuda/trees/lbvh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
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

/// Equal sums of corners: exact for floats.
bool same_middle(const fast::Aabb& a, const fast::Aabb& b)
{
    const auto twice = [](const fast::Aabb& box) {
        return scenes::Vec3(box.lower) + scenes::Vec3(box.upper);
    };
    return twice(a) == twice(b);
}

JudgedTree judged_floats(const AnyBuilder& builder, std::span<const fast::Aabb> boxes)
{
    if (const auto* fast_builder = std::get_if<fast::TreeBuilder>(&builder))
        return judged(*fast_builder, boxes);
    std::vector<ref::Aabb> exact;
    exact.reserve(boxes.size());
    for (const fast::Aabb& box : boxes)
        exact.push_back({scenes::Vec3(box.lower), scenes::Vec3(box.upper)});
    return judged(std::get<ref::Builder>(builder), exact);
}

/// Throws, with a message, what the fast path throws for too many primitives; also if there is not
/// enough memory.
void check_size(const AnyBuilder& builder, double n)
{
    if (std::holds_alternative<fast::TreeBuilder>(builder) && n > fast::most_primitives) {
        fast::HostMemory memory;
        const fast::Lbvh<std::uint64_t> refused(memory, fast::SerialExecutor{},
                                                static_cast<std::uint32_t>(std::min(n, 0x1p32 - 1)));
    }
    const double needed = n * (24 + bytes_of_build(builder));
    if (const double free = free_memory(); needed > free) {
        const auto gib = [](double bytes) {
            return std::to_string(std::lround(bytes * 0x1p-30)) + " GiB";
        };
        throw std::runtime_error("needs " + gib(needed) + " of memory, of which " + gib(free) +
                                 " are free");
    }
}

void run_tree_size(const AnyBuilder& builder, double parameter, Random& random, int cases, Tally& tally)
{
    for (int i = 0; i < cases; ++i) {
        try {
            check_size(builder, parameter);
            if (builder == AnyBuilder(ref::Builder::sah) && parameter > most_boxes_of_sweep) {
                tally.add(Failure::endless);
                continue;
            }
            const std::vector<fast::Aabb> boxes =
                many_boxes(static_cast<std::uint32_t>(parameter), random);
            const JudgedTree tree = judged_floats(builder, boxes);
            if (!tree.fault.empty() || tree.depth > depth_bound(builder, boxes.size()))
                tally.add(Failure::wrong_order);
            else
                tally.add(lost_order(tree, [&](std::uint32_t a, std::uint32_t b) {
                    return same_middle(boxes[a], boxes[b]);
                }));
        } catch (const std::invalid_argument& error) {
            tally.refuse(error.what());
        } catch (const std::runtime_error& error) {
            tally.refuse(error.what());
        }
    }
}

} // namespace

namespace {

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
    axis.about = "A case is one tree over random boxes in the unit cube. The error is the share of "
                 "neighbours, in the "
                 "order of the leaves, that have the same code though their centroids differ: their "
                 "order along the "
                 "curve is lost. The sweep has no codes and no error; beyond four million boxes it "
                 "takes minutes, and "
                 "is not tried. A tree that is not valid or deeper than its bound is a failure. A tree "
                 "that would need "
                 "more memory than there is, or numbers of more than 29 bits, is refused.";
    axis.ordinary = 1024;
    axis.logarithmic = true;
    for (int k = 0; k <= 22; k += 2) axis.values.push_back(std::ldexp(1.0, k));
    axis.values.push_back(24'000'000); // where 1% of 30-bit codes are lost
    axis.values.push_back(0x1p30);
    axis.most_cases = 1;
    axis.methods = tree_methods(run_tree_size);
    const std::string tried = "nothing fails up to here, the most that a test has the time for";
    const std::string refused = tried + "; more than 2^29 primitives are refused";
    const auto limit = [&](const std::string& method, int bits, Format format, bool is_fast) {
        axis.limits.push_back({method, 0x1p20, [=](double n) { return lost_by_size(n, bits, format); },
                               is_fast ? 0x1p30 : no_failure,
                               is_fast ? Failure::refused : Failure::inaccurate,
                               is_fast ? refused : tried});
    };
    limit("ref, morton30", 10, Format::binary64, false);
    limit("ref, morton63", 21, Format::binary64, false);
    limit("host, morton30", 10, Format::binary32, true);
    limit("host, morton63", 21, Format::binary32, true);
    limit("host, hploc30", 10, Format::binary32, true);
    limit("host, hploc63", 21, Format::binary32, true);
    axis.limits.push_back(
        {"ref, sah", 0x1p17, [](double) { return 0.0; }, no_failure, Failure::inaccurate, tried});
    axis.derivation = "$n$ random centroids in $N = 2^{30}$ cells share one with $n (n - 1) / (2 N)$ "
                      "pairs: a share of "
                      "$n / 2^{31}$ of all neighbours, and 1% from 21 million primitives on.";
    return axis;
}

} // namespace extremes
