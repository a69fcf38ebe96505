#pragma once

// Four floats that are computed with at the same time. On the host they are one vector of the processor
// (by the extension that g++ and clang share, which needs no header and runs on every processor); for
// nvcc, which gives every thread one float at a time anyway, an array.

#include "cuda/parallel/host_device.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace gpu {

/// Sorts behind all other keys.
constexpr std::uint32_t not_ordered = 0xffff'ffff;

#if defined(__CUDACC__)

struct alignas(16) Lanes { // in memory the same as the other
    float lane[4];

    HD float operator[](int i) const { return lane[i]; }
    HD float& operator[](int i) { return lane[i]; }
};

HD inline Lanes all_lanes(float x)
{
    return {{x, x, x, x}};
}

HD inline Lanes operator-(const Lanes& a, const Lanes& b)
{
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]}};
}

HD inline Lanes operator+(const Lanes& a, const Lanes& b)
{
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]}};
}

HD inline Lanes operator*(const Lanes& a, const Lanes& b)
{
    return {{a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]}};
}

/// a where a > b, else b: b where one of them is NaN.
HD inline Lanes larger(const Lanes& a, const Lanes& b)
{
    Lanes result;
    for (int i = 0; i < 4; ++i) result[i] = a[i] > b[i] ? a[i] : b[i];
    return result;
}

/// a where a < b, else b: b where one of them is NaN.
HD inline Lanes smaller(const Lanes& a, const Lanes& b)
{
    Lanes result;
    for (int i = 0; i < 4; ++i) result[i] = a[i] < b[i] ? a[i] : b[i];
    return result;
}

/// See below.
HD inline void sortable(const Lanes& near, const Lanes& far, std::uint32_t (&keys)[4])
{
    for (std::uint32_t i = 0; i < 4; ++i) {
        const bool ordered = near[static_cast<int>(i)] <= far[static_cast<int>(i)];
        keys[i] =
            ordered ? (std::bit_cast<std::uint32_t>(near[static_cast<int>(i)]) & ~3u) | i : not_ordered;
    }
}

#else

using Lanes = float __attribute__((vector_size(16)));

inline Lanes all_lanes(float x)
{
    return Lanes{x, x, x, x};
}

/// a where a > b, else b: b where one of them is NaN.
inline Lanes larger(const Lanes& a, const Lanes& b)
{
    return a > b ? a : b;
}

/// a where a < b, else b: b where one of them is NaN.
inline Lanes smaller(const Lanes& a, const Lanes& b)
{
    return a < b ? a : b;
}

/// For every lane a number that sorts like `near` (which must not be negative: then its bits sort like
/// itself), with the number of the lane in its lowest two bits; not_ordered, unless near <= far. Without
/// those two bits it is the bits of `near`, or of a float up to 3 ulps below it.
inline void sortable(const Lanes& near, const Lanes& far, std::uint32_t (&keys)[4])
{
    using Words = std::uint32_t __attribute__((vector_size(16)));
    const Words named = (std::bit_cast<Words>(near) & ~3u) | Words{0, 1, 2, 3};
    const Words sorted = near <= far ? named : Words{not_ordered, not_ordered, not_ordered, not_ordered};
    std::memcpy(keys, &sorted, sizeof keys);
}

#endif

} // namespace gpu
