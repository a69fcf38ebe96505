// Codes in single precision compared with those of the reference.

#include "cuda/trees/morton.h"

#include "cuda/parallel/executor.h"
#include "cuda/parallel/reduce.h"
#include "ref/trees/bvh.h"
#include "ref/trees/morton.h"
#include "tests/cuda/trees/build_on.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace {

using fast_trees_test::rounded;
using trees_test::Kind;
using trees_test::Random;

/// The codes of boxes in the order of the boxes, computed by the kernels alone.
template <class Code>
std::vector<std::uint64_t> codes_of(const std::vector<fast::Aabb>& boxes)
{
    const fast::SerialExecutor executor;
    const auto n = static_cast<std::uint32_t>(boxes.size());
    std::vector<fast::CentroidBounds> scratch(1);
    std::vector<fast::CentroidBounds> centroid_bounds(1);
    map_reduce(executor, n, fast::BoundCentroid{boxes}, fast::UniteCentroidBounds{},
               fast::empty_centroid_bounds(), std::span(scratch), std::span(centroid_bounds));
    std::vector<Code> codes(n);
    std::vector<std::uint32_t> primitives(n);
    executor(n, fast::ComputeMortonCodes<Code>{boxes, centroid_bounds, codes, primitives});
    for (std::uint32_t i = 0; i < n; ++i) EXPECT_EQ(primitives[i], i);
    return {codes.begin(), codes.end()};
}

std::vector<std::uint64_t> codes_of(const std::vector<fast::Aabb>& boxes, int bits)
{
    return bits == 10 ? codes_of<std::uint32_t>(boxes) : codes_of<std::uint64_t>(boxes);
}

RC_GTEST_PROP(MortonCodeInFloat, SpreadsBitsAsTheReferenceDoes, ()) // map: morton-code
{
    const auto x = *rc::gen::inRange<std::uint32_t>(0, 1u << 21);
    RC_ASSERT(fast::spread_bits(std::uint64_t{x}) == ref::spread_bits(x));
    RC_ASSERT(fast::spread_bits(x & 0x3ff) == ref::spread_bits(x & 0x3ff));
}

TEST(MortonCodeInFloat, SpreadsEveryBitToItsPlace)
{
    for (int bit = 0; bit < 21; ++bit)
        EXPECT_EQ(fast::spread_bits(std::uint64_t{1} << bit), std::uint64_t{1} << 3 * bit);
    for (int bit = 0; bit < 10; ++bit) EXPECT_EQ(fast::spread_bits(1u << bit), 1u << 3 * bit);
}

/// The largest distance, in cells along an axis, between the code in float and exact arithmetic: see
/// the head of morton.h. The reference computes in double from the same floats. Its own error is below
/// the term of second order, for which 1% is added; the smallest denormal covers halves that are not
/// exact.
double cells_apart(const std::vector<ref::Aabb>& boxes, int axis, int bits)
{
    double M = 0;
    double lower = std::numeric_limits<double>::infinity();
    double upper = -lower;
    for (const ref::Aabb& box : boxes) {
        M = std::max({M, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
        lower = std::min(lower, centroid(box)[axis]);
        upper = std::max(upper, centroid(box)[axis]);
    }
    const double error = 0x1p-24 * M + 0x1p-149;
    // Where rounding may remove the whole extent, there is no bound.
    if (upper - lower <= 4 * error) return std::ldexp(1, bits);
    return std::ceil(1.01 * std::ldexp(4 * error / (upper - lower - 2 * error) + 3 * 0x1p-24, bits));
}

RC_GTEST_PROP(MortonCodeInFloat, IsAFewCellsFromTheReferenceAlongEachAxis, ()) // map: morton-cell
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const auto kind = static_cast<Kind>(*rc::gen::inRange(0, trees_test::kinds));
    const int bits = *rc::gen::element(10, 21);
    const auto boxes = rounded(trees_test::boxes(kind, *rc::gen::inRange<std::size_t>(1, 200), random));
    const auto exact = fast_trees_test::exactly(boxes);
    const std::vector<std::uint64_t> mine = codes_of(boxes, bits);
    const std::vector<std::uint64_t> reference = ref::morton_codes(exact, bits);
    for (int axis = 0; axis < 3; ++axis) {
        const double bound = cells_apart(exact, axis, bits);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const auto cell = [&](std::uint64_t code) {
                return static_cast<double>(ref::morton_decode(code)[static_cast<std::size_t>(axis)]);
            };
            RC_ASSERT(std::abs(cell(mine[i]) - cell(reference[i])) <= bound);
        }
    }
}

TEST(MortonCodeInFloat, TheBoundIsOneCellForThirtyBitsOfAnOrdinaryScene) // otherwise an empty test
{
    Random random(1);
    const auto boxes = fast_trees_test::exactly(rounded(trees_test::boxes(Kind::uniform, 200, random)));
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(cells_apart(boxes, axis, 10), 1);
        EXPECT_LE(cells_apart(boxes, axis, 21), 1 + 7 * 0x1p21 * 0x1p-24);
    }
}

constexpr float largest = std::numeric_limits<float>::max();
constexpr float smallest = std::numeric_limits<float>::denorm_min();

fast::Aabb point(float x, float y, float z)
{
    return {fast::Vec3(x, y, z), fast::Vec3(x, y, z)};
}

TEST(MortonCodeInFloat, NoScaleOverflowsOrVanishes)
{
    for (const float scale :
         {largest, 1e38f, 1e30f, 1.0f, 1e-30f, 1e-38f, 1024 * smallest, 4 * smallest})
        for (const int bits : {10, 21}) {
            const std::vector<fast::Aabb> boxes = {point(-scale, -scale, -scale),
                                                   point(scale, scale, scale), point(0, 0, 0),
                                                   point(-scale, scale, scale / 2)};
            const std::uint32_t n = 1u << bits;
            const auto codes = codes_of(boxes, bits);
            EXPECT_EQ(ref::morton_decode(codes[0]), (ref::Cell{0, 0, 0})) << scale;
            EXPECT_EQ(ref::morton_decode(codes[1]), (ref::Cell{n - 1, n - 1, n - 1})) << scale;
            EXPECT_EQ(ref::morton_decode(codes[2]), (ref::Cell{n / 2, n / 2, n / 2})) << scale;
            EXPECT_EQ(ref::morton_decode(codes[3]), (ref::Cell{0, n - 1, n / 4 * 3})) << scale;
        }
}

TEST(MortonCodeInFloat, AFlatAxisHasOneCell)
{
    const std::vector<fast::Aabb> boxes = {point(0, 5, -1), point(1, 5, -1), point(0.5f, 5, -1)};
    const auto codes = codes_of(boxes, 10);
    EXPECT_EQ(ref::morton_decode(codes[0]), (ref::Cell{0, 0, 0}));
    EXPECT_EQ(ref::morton_decode(codes[1]), (ref::Cell{1023, 0, 0}));
    EXPECT_EQ(ref::morton_decode(codes[2]), (ref::Cell{512, 0, 0}));
}

TEST(MortonCodeInFloat, SpansTheGridOverCentroidsOfLegalBoxesAlone)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<fast::Aabb> boxes = {point(0, 0, 0),
                                     point(1, 1, 1),
                                     {fast::Vec3(-1000), fast::Vec3(1001)},
                                     point(nan, 7, 7),
                                     {fast::Vec3(9), fast::Vec3(8)}};
    const auto codes = codes_of(boxes, 10);
    EXPECT_EQ(codes[0], 0u);
    EXPECT_EQ(codes[1], 0x3fff'ffffu);
    EXPECT_EQ(codes[2], 7u << 27); // 0.5: the middle cell
}

} // namespace
