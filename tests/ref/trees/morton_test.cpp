#include "ref/trees/morton.h"

#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace {

using ref::Aabb;
using ref::Cell;
using ref::morton_decode;
using ref::morton_encode;
using ref::Vec3;
using trees_test::Random;

/// Bit by bit, the most significant first: x0 y0 z0 x1 y1 z1 ...
std::uint64_t interleave(const Cell& cell, int bits)
{
    std::uint64_t code = 0;
    for (int bit = bits - 1; bit >= 0; --bit)
        for (const std::uint32_t coordinate : cell) code = code << 1 | (coordinate >> bit & 1);
    return code;
}

TEST(MortonCode, BitsAlternateWithXFirst) // map: morton-code
{
    EXPECT_EQ(morton_encode({0b0000000001, 0b0000000000, 0b0000000000}), 0b000'000'000'100u);
    EXPECT_EQ(morton_encode({0b0000000000, 0b0000000001, 0b0000000000}), 0b000'000'000'010u);
    EXPECT_EQ(morton_encode({0b0000000000, 0b0000000000, 0b0000000001}), 0b000'000'000'001u);
    EXPECT_EQ(morton_encode({0b0000001010, 0b0000000110, 0b0000000011}), 0b100'010'111'001u);
    EXPECT_EQ(morton_encode({0b1111111111, 0b0000000000, 0b1111111111}),
              0b101'101'101'101'101'101'101'101'101'101u);
    EXPECT_EQ(morton_encode({0x1f'ffff, 0x1f'ffff, 0x1f'ffff}), 0x7fff'ffff'ffff'ffffu);
}

TEST(MortonCode, EveryCellOfACoarseGridIsEncodedAsBitByBitAndDecodesToItself)
{
    std::vector<bool> seen(32 * 32 * 32, false);
    for (std::uint32_t x = 0; x < 32; ++x)
        for (std::uint32_t y = 0; y < 32; ++y)
            for (std::uint32_t z = 0; z < 32; ++z) {
                const Cell cell{x, y, z};
                const std::uint64_t code = morton_encode(cell);
                ASSERT_EQ(code, interleave(cell, 5));
                ASSERT_EQ(morton_decode(code), cell);
                ASSERT_FALSE(seen[code]);
                seen[code] = true;
            }
}

Cell any_cell(int bits)
{
    const auto coordinate = rc::gen::inRange<std::uint32_t>(0, 1u << bits);
    return {*coordinate, *coordinate, *coordinate};
}

RC_GTEST_PROP(MortonCode, IsTheInterleavedCoordinatesAndDecodesToThem, ())
{
    const int bits = *rc::gen::element(10, 21);
    const Cell cell = any_cell(bits);
    RC_ASSERT(morton_encode(cell) == interleave(cell, bits));
    RC_ASSERT(morton_decode(morton_encode(cell)) == cell);
    RC_ASSERT(morton_encode(cell) < std::uint64_t{1} << 3 * bits);
}

RC_GTEST_PROP(MortonCode, GrowsWithEveryAxis, ())
{
    const int bits = *rc::gen::element(10, 21);
    const Cell low = any_cell(bits);
    Cell high = any_cell(bits);
    for (std::size_t axis = 0; axis < 3; ++axis) high[axis] = std::max(low[axis], high[axis]);
    RC_ASSERT(morton_encode(low) <= morton_encode(high));
    RC_ASSERT((morton_encode(low) == morton_encode(high)) == (low == high));
}

// The order along the curve: the octants at the coarsest level where two cells differ decide. Octants
// are ordered with z fastest and x slowest.
RC_GTEST_PROP(MortonCode, OrderIsTheOrderAlongTheCurve, ())
{
    const Cell a = any_cell(21);
    const Cell b =
        *rc::gen::element(any_cell(21), Cell{a[0], any_cell(21)[1], a[2]}, Cell{a[0] ^ 1, a[1], a[2]});
    bool before = false;
    for (int bit = 20; bit >= 0; --bit) {
        const auto octant = [&](const Cell& cell) {
            return std::array{cell[0] >> bit & 1, cell[1] >> bit & 1, cell[2] >> bit & 1};
        };
        if (octant(a) == octant(b)) continue;
        before = octant(a) < octant(b);
        break;
    }
    RC_ASSERT((morton_encode(a) < morton_encode(b)) == before);
}

RC_GTEST_PROP(MortonCode, DecodesToTheCellThatHoldsThePoint, ()) // map: morton-cell
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const int bits = *rc::gen::element(10, 21);
    const double scale = random.magnitude(-30, 30);
    const Vec3 a = scale * random.in_cube();
    const Vec3 b = scale * random.in_cube();
    const Aabb grid{glm::min(a, b), glm::max(a, b)};
    const double w = *rc::gen::element(0.0, 1.0, random.uniform());
    const Vec3 point = glm::clamp(grid.lower + w * (grid.upper - grid.lower), grid.lower, grid.upper);
    const Cell cell = morton_decode(morton_code(point, grid, bits));
    for (int axis = 0; axis < 3; ++axis) {
        const double width = (grid.upper[axis] - grid.lower[axis]) / std::ldexp(1, bits);
        const double in_cell =
            (point[axis] - grid.lower[axis]) / width - cell[static_cast<std::size_t>(axis)];
        // Two differences and two quotients, each with an error of u times up to 2^21 cells.
        RC_ASSERT(in_cell >= -4 * 0x1p-53 * 0x1p21);
        RC_ASSERT(in_cell <= 1 + 4 * 0x1p-53 * 0x1p21);
    }
}

TEST(MortonCode, TheCornersOfTheGridAreItsFirstAndLastCell)
{
    const Aabb grid{Vec3(-3, 1, 1e-9), Vec3(7, 2, 1e9)};
    EXPECT_EQ(morton_code(grid.lower, grid, 10), 0u);
    EXPECT_EQ(morton_code(grid.upper, grid, 10), 0x3fff'ffffu);
    EXPECT_EQ(morton_code(grid.upper, grid, 21), 0x7fff'ffff'ffff'ffffu);
}

TEST(MortonCode, AFlatAxisHasOneCell)
{
    const Aabb grid{Vec3(1, 5, 2), Vec3(2, 5, 2)};
    EXPECT_EQ(ref::cell_of(Vec3(1.5, 5, 2), grid, 10), (Cell{512, 0, 0}));
    EXPECT_EQ(ref::cell_of(Vec3(2, 5, 2), grid, 10), (Cell{1023, 0, 0}));
    // Some processors convert 0/0 to the integer 0, so the cells above do not show it.
    EXPECT_EQ(ref::relative_position(5, 5, 5), 0.0);
}

TEST(MortonCode, NoScaleOverflowsOrVanishes)
{
    const double largest = std::numeric_limits<double>::max();
    const double smallest = std::numeric_limits<double>::denorm_min();
    for (const double scale : {largest, 1e300, 1e30, 1e-30, 1e-300, 1024 * smallest}) {
        const Aabb grid{Vec3(-scale), Vec3(scale)};
        EXPECT_EQ(ref::cell_of(Vec3(0), grid, 10), (Cell{512, 512, 512})) << scale;
        EXPECT_EQ(ref::cell_of(Vec3(-scale, scale, scale / 2), grid, 10), (Cell{0, 1023, 768})) << scale;
    }
    const Aabb next{Vec3(0), Vec3(smallest)};
    EXPECT_EQ(ref::cell_of(Vec3(smallest, 0, smallest), next, 10), (Cell{1023, 0, 1023}));
}

} // namespace
