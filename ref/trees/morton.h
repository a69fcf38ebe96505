#pragma once

// Morton codes: the bits of three cell coordinates interleaved, x first: x0 y0 z0 x1 y1 z1 ..., from
// the most significant down. Points sorted by code are close to their neighbours in space [Lauterbach
// 2009, sec. 3.1].

#include "ref/trees/aabb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace ref {

/// The coordinates of a cell in a grid of 2^b cells per axis.
using Cell = std::array<std::uint32_t, 3>;

/// Moves bit i of the low 21 bits of `x` to bit 3 i: each step halves the groups and doubles the gaps.
inline std::uint64_t spread_bits(std::uint64_t x)
{
    x &= 0x1f'ffff;
    x = (x | x << 32) & 0x001f'0000'0000'ffff;
    x = (x | x << 16) & 0x001f'0000'ff00'00ff;
    x = (x | x << 8) & 0x100f'00f0'0f00'f00f;
    x = (x | x << 4) & 0x10c3'0c30'c30c'30c3;
    x = (x | x << 2) & 0x1249'2492'4924'9249;
    return x;
}

/// The inverse: gathers bits 0, 3, 6, ... of `x`.
inline std::uint32_t gather_bits(std::uint64_t x)
{
    x &= 0x1249'2492'4924'9249;
    x = (x | x >> 2) & 0x10c3'0c30'c30c'30c3;
    x = (x | x >> 4) & 0x100f'00f0'0f00'f00f;
    x = (x | x >> 8) & 0x001f'0000'ff00'00ff;
    x = (x | x >> 16) & 0x001f'0000'0000'ffff;
    x = (x | x >> 32) & 0x1f'ffff;
    return static_cast<std::uint32_t>(x);
}

/// The code of a cell: 30 bits for coordinates below 2^10, 63 for coordinates below 2^21.
inline std::uint64_t morton_encode(const Cell& cell)
{
    // map: morton-code [Lauterbach 2009, sec. 3.1]
    return spread_bits(cell[0]) << 2 | spread_bits(cell[1]) << 1 | spread_bits(cell[2]);
}

inline Cell morton_decode(std::uint64_t code)
{
    return {gather_bits(code >> 2), gather_bits(code >> 1), gather_bits(code)};
}

/// The position of `x` between `lower` and `upper`, from 0 to 1; 0 if lower >= upper, so that a flat
/// axis has one cell (and there is no 0/0). Halves its operands where the difference would overflow;
/// finite for all finite numbers.
inline double relative_position(double x, double lower, double upper)
{
    if (!(lower < upper)) return 0;
    if (std::isfinite(upper - lower)) return (x - lower) / (upper - lower);
    return (x / 2 - lower / 2) / (upper / 2 - lower / 2);
}

/// The cell of `point` in `grid`, which is divided into 2^bits_per_axis cells per axis.
inline Cell cell_of(const Vec3& point, const Aabb& grid, int bits_per_axis)
{
    const double cells = std::ldexp(1, bits_per_axis);
    const auto coordinate = [&](double x, double lower, double upper) {
        // x = upper would give a cell number beyond the last one.
        return static_cast<std::uint32_t>(
            std::min(relative_position(x, lower, upper) * cells, cells - 1)); // map: morton-cell
    };
    return {coordinate(point.x, grid.lower.x, grid.upper.x),
            coordinate(point.y, grid.lower.y, grid.upper.y),
            coordinate(point.z, grid.lower.z, grid.upper.z)};
}

/// The code of `point`: 30 bits for 10 bits per axis, 63 bits for 21.
inline std::uint64_t morton_code(const Vec3& point, const Aabb& grid, int bits_per_axis)
{
    return morton_encode(cell_of(point, grid, bits_per_axis));
}

} // namespace ref
