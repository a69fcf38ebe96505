#pragma once

// Morton codes in single precision: the bits of three cell coordinates interleaved, x0 y0 z0 x1 y1 z1
// ... from the most significant down [Lauterbach 2009, sec. 3.1].
//
// How far can a cell be from the one that exact arithmetic gives? Let u = 2^-24 be the unit roundoff,
// M the largest magnitude of a coordinate along an axis, E the extent of the centroids there, and 2^b
// the number of cells. A centroid is rounded by at most u M (halving is exact, above the denormal
// numbers), and so are both ends of the grid, which are centroids. The position is p = (x - l) / (h -
// l), in 0 to 1. Its numerator has an error of 2 u M, and its denominator one of 2 u M, which together
// move p by at most 2 u M / E (1 + p). The two differences and the quotient add roundings of 3 u p;
// the multiplication by 2^b is exact. So the product has an error of 2^b (4 u M / E + 3 u) to first
// order, and the cell, its integer part, differs by at most that, rounded up.

#include "cuda/trees/centroid_bounds.h"

#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

namespace fast {

/// 30 bits, 10 per axis, in 32; 63 bits, 21 per axis, in 64.
template <class Code>
constexpr int bits_per_axis = std::is_same_v<Code, std::uint32_t> ? 10 : 21;
template <class Code>
constexpr int code_bits = 3 * bits_per_axis<Code>;

/// Moves bit i of the low 10 bits of `x` to bit 3 i: every step splits each group of bits in two and
/// moves the upper half away by twice its width.
HD inline std::uint32_t spread_bits(std::uint32_t x)
{
    x = (x | x << 16) & 0x0300'00ffu;
    x = (x | x << 8) & 0x0300'f00fu;
    x = (x | x << 4) & 0x030c'30c3u;
    x = (x | x << 2) & 0x0924'9249u;
    return x;
}

/// The same for the low 21 bits.
HD inline std::uint64_t spread_bits(std::uint64_t x)
{
    x = (x | x << 32) & 0x001f'0000'0000'ffffu;
    x = (x | x << 16) & 0x001f'0000'ff00'00ffu;
    x = (x | x << 8) & 0x100f'00f0'0f00'f00fu;
    x = (x | x << 4) & 0x10c3'0c30'c30c'30c3u;
    x = (x | x << 2) & 0x1249'2492'4924'9249u;
    return x;
}

/// The cell of `x` between `lower` and `upper`, one of 2^bits cells. An axis without extent has one
/// cell. If the extent overflows, halves are used instead. For NaN the result is cell 0.
HD inline std::uint32_t cell_along_axis(float x, float lower, float upper, int bits)
{
    const float cells = static_cast<float>(1u << bits);
    const bool is_huge = upper - lower > std::numeric_limits<float>::max();
    const float scale = is_huge ? 0.5f : 1.0f;
    const float position = (scale * x - scale * lower) / (scale * upper - scale * lower);
    if (!(position > 0)) return 0;       // also for 0 / 0
    const float cell = position * cells; // map: morton-cell
    return static_cast<std::uint32_t>(cell < cells - 1 ? cell : cells - 1);
}

template <class Code>
HD Code morton_code(const Vec3& point, const Aabb& grid)
{
    constexpr int bits = bits_per_axis<Code>;
    const Code x = cell_along_axis(point.x, grid.lower.x, grid.upper.x, bits);
    const Code y = cell_along_axis(point.y, grid.lower.y, grid.upper.y, bits);
    const Code z = cell_along_axis(point.z, grid.lower.z, grid.upper.z, bits);
    return spread_bits(x) << 2 | spread_bits(y) << 1 | spread_bits(z); // map: morton-code
}

/// Kernel over primitives: the code of the centroid, in the grid over all centroids.
template <class Code>
struct ComputeMortonCodes {
    std::span<const Aabb> boxes;
    std::span<const CentroidBounds> centroid_bounds; // one
    std::span<Code> codes;
    std::span<std::uint32_t> primitives;

    HD void operator()(std::uint32_t primitive) const
    {
        codes[primitive] = morton_code<Code>(centroid(boxes[primitive]), centroid_bounds[0].box);
        primitives[primitive] = primitive;
    }
};

} // namespace fast
