// Primitives so close together that a Morton code cannot tell them apart.

#include "extremes/axes/axes.h"
#include "extremes/trees/tree_builds.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace extremes {

namespace {

constexpr std::uint32_t pairs_of_key_bits = 1u << 13;
constexpr double grid_of_centroids = 0x1p52; // centroids are multiples of its reciprocal

/// Points in the unit cube in pairs: of each, both coordinates along every axis are random in an
/// interval of length `spread`, somewhere. Point i and point i + pairs_of_key_bits are a pair. Two more
/// points are the corners of the cube, so that cells are 2^-10 or 2^-21 wide. All numbers are exact.
std::vector<scenes::Vec3> close_pairs(double spread, Random& random)
{
    const auto on_grid = [](double x) { return std::round(x * grid_of_centroids) / grid_of_centroids; };
    std::vector<scenes::Vec3> points(2 * pairs_of_key_bits);
    for (std::uint32_t i = 0; i < pairs_of_key_bits; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            const double from = (1 - spread) * random.uniform();
            points[i][axis] = on_grid(from + spread * random.uniform());
            points[i + pairs_of_key_bits][axis] = on_grid(from + spread * random.uniform());
        }
    points.emplace_back(0.0);
    points.emplace_back(1.0);
    return points;
}

void run_key_bits(const AnyBuilder& builder, double spread, Random& random, int cases, Tally& tally)
{
    for (int i = 0; i < cases; ++i) {
        const std::vector<scenes::Vec3> points = close_pairs(spread, random);
        std::vector<ref::Aabb> boxes;
        boxes.reserve(points.size());
        for (const scenes::Vec3& point : points) boxes.push_back({point, point});
        const JudgedTree tree = judged(builder, boxes);
        if (!tree.fault.empty() || tree.depth > depth_bound(builder, boxes.size())) {
            tally.add(Failure::wrong_order);
            continue;
        }
        if (tree.codes.empty()) {
            tally.add(0.0); // no codes
            continue;
        }
        std::vector<std::uint64_t> codes(points.size());
        for (std::size_t leaf = 0; leaf < points.size(); ++leaf)
            codes[tree.primitives[leaf]] = tree.codes[leaf];
        std::uint32_t lost = 0;
        for (std::uint32_t a = 0, b = pairs_of_key_bits; a < pairs_of_key_bits; ++a, ++b)
            if (codes[a] == codes[b] && points[a] != points[b]) ++lost;
        tally.add(static_cast<double>(lost) / pairs_of_key_bits);
    }
}

// Let w be the width of a cell and s the spread of a pair. The distance d of two numbers that are
// uniform on an interval of length s has the density 2 (s - d) / s^2. Where the cells lie is random, and
// the two are in the same cell with the probability max(0, 1 - d / w). The mean of that is x - x^2 / 3,
// where x = w / s <= 1; and along three axes it is the cube.
//
// In single precision a cell number is still a function of the coordinate that does not decrease, since
// every rounding is one; but the ends of a cell are moved. With M = E = 1 and points for boxes, a
// coordinate is rounded by u / 2, and the difference (0 is exact), the quotient by the extent 1 and the
// product round no more: by less than 2^b u = 1/8 of a cell of 63 bits (b = 21, u = 2^-24), at each end.
// So no two numbers are in one cell that are farther apart than (1 + 2 / 8) w; the same for w' = 1.25 w
// holds as a bound. For 30 bits w' = (1 + 2^-13) w.
//
// Of the m pairs of a case, the number that are lost is binomial: 6 standard deviations, and a few for
// small means, are exceeded in fewer than 1 of 10^6 cases.
double lost_pairs(double spread, double cell)
{
    const double x = std::min(1.0, cell / spread);
    const double along_axis = x < 1 ? x - x * x / 3 : 1 - spread / (3 * cell);
    const double share = along_axis * along_axis * along_axis;
    return share + 6 * std::sqrt(share / pairs_of_key_bits) + 6.0 / pairs_of_key_bits;
}

} // namespace

Axis key_bits_axis()
{
    Axis axis;
    axis.number = 12;
    axis.name = "key-bits";
    axis.title = "Bits of a Morton code";
    axis.parameter = "distance of neighbours, relative to the scene";
    axis.about =
        "A case is a tree over 16,386 points in 8,192 pairs. Both points of a pair are random in a "
        "cube, as large as the parameter says, somewhere in the unit cube. The error is the share "
        "of pairs that have the same code though they differ: a tree cannot order them along the "
        "curve, nor separate them by where they are. The sweep has no codes and no error.";
    axis.ordinary = 0.1;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-12, -1, 0.5);
    axis.values.push_back(1);
    axis.most_cases = 50;
    axis.methods = tree_methods(run_key_bits);
    constexpr double cell30 = 0x1p-10;
    constexpr double cell63 = 0x1p-21;
    const auto limit = [&](const std::string& method, double cell, double widened, const char* bits) {
        axis.limits.push_back(
            {method, 6 * widened, [widened](double s) { return lost_pairs(s, widened); }, 3 * cell,
             Failure::inaccurate,
             std::string("a code has ") + bits +
                 " bits per axis: of pairs as close as 4 cells, 1% have the same code"});
    };
    limit("ref, morton30", cell30, cell30, "10");
    limit("ref, morton63", cell63, cell63, "21");
    limit("host, morton30", cell30, (1 + 0x1p-13) * cell30, "10");
    limit("host, morton63", cell63, 1.25 * cell63, "21");
    limit("host, hploc30", cell30, (1 + 0x1p-13) * cell30, "10");
    limit("host, hploc63", cell63, 1.25 * cell63, "21");
    axis.limits.push_back({"ref, sah", 1e-12, [](double) { return 0.0; }, no_failure,
                           Failure::inaccurate,
                           "the sweep orders centroids as they are, without codes"});
    return axis;
}

} // namespace extremes
