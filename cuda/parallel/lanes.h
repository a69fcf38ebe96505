#pragma once

// Four floats, added, multiplied and compared lane by lane. On the host they are one vector register (by
// the vector extension of g++ and clang, which runs on every processor). For nvcc they are an array,
// because on a GPU each thread computes one float at a time.

#include "cuda/parallel/host_device.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace fast {

/// The key of a lane that is left out; it sorts behind all other keys.
constexpr std::uint32_t not_ordered = 0xffff'ffff;

#if defined(__CUDACC__)

/// Whether four lanes take as long as one.
constexpr bool lanes_at_once = false;

struct alignas(16) Lanes { // same layout in memory as the host's Lanes
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

/// a where a > b, else b; so b where one of them is NaN.
HD inline Lanes larger(const Lanes& a, const Lanes& b)
{
    Lanes result;
    for (int i = 0; i < 4; ++i) result[i] = a[i] > b[i] ? a[i] : b[i];
    return result;
}

/// a where a < b, else b; so b where one of them is NaN.
HD inline Lanes smaller(const Lanes& a, const Lanes& b)
{
    Lanes result;
    for (int i = 0; i < 4; ++i) result[i] = a[i] < b[i] ? a[i] : b[i];
    return result;
}

HD inline Lanes operator-(const Lanes& a)
{
    return {{-a[0], -a[1], -a[2], -a[3]}};
}

/// See below.
HD inline void sort_keys(const Lanes& near, const Lanes& far, std::uint32_t (&keys)[4])
{
    for (std::uint32_t i = 0; i < 4; ++i) {
        const bool ordered = near[static_cast<int>(i)] <= far[static_cast<int>(i)];
        keys[i] =
            ordered ? (std::bit_cast<std::uint32_t>(near[static_cast<int>(i)]) & ~3u) | i : not_ordered;
    }
}

/// See below.
HD inline std::uint32_t non_negative_mask(const Lanes& a)
{
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits |= a[i] >= 0 ? 1u << i : 0u;
    return bits;
}

#else

constexpr bool lanes_at_once = true;

using Lanes = float __attribute__((vector_size(16)));

inline Lanes all_lanes(float x)
{
    return Lanes{x, x, x, x};
}

/// a where a > b, else b; so b where one of them is NaN.
inline Lanes larger(const Lanes& a, const Lanes& b)
{
    return a > b ? a : b;
}

/// a where a < b, else b; so b where one of them is NaN.
inline Lanes smaller(const Lanes& a, const Lanes& b)
{
    return a < b ? a : b;
}

using Words = std::uint32_t __attribute__((vector_size(16)));

/// Keys that sort lanes by `near` in ascending order. The key of a lane is the bits of its `near` with
/// the lane's number in the lowest two bits; not_ordered where near > far. The bits of floats >= 0
/// sort like the floats: `near` must be >= 0, and neither argument may be NaN. With those two bits
/// cleared, a key is a float that equals `near` or lies at most 3 ulps below it.
inline void sort_keys(const Lanes& near, const Lanes& far, std::uint32_t (&keys)[4])
{
    const Words named = (std::bit_cast<Words>(near) & ~3u) | Words{0, 1, 2, 3};
    const Words sorted = named | std::bit_cast<Words>(near > far);
    std::memcpy(keys, &sorted, sizeof keys);
}

/// Bit i is set where a[i] >= 0; not where a[i] is NaN.
inline std::uint32_t non_negative_mask(const Lanes& a)
{
    const Words bits = std::bit_cast<Words>(a >= Lanes{0, 0, 0, 0}) & Words{1, 2, 4, 8};
    const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(bits);
    const std::uint64_t both = halves[0] | halves[1];
    return static_cast<std::uint32_t>(both | both >> 32);
}

#endif

/// The absolute value.
HD inline Lanes magnitude(const Lanes& a)
{
    return larger(a, -a);
}

} // namespace fast
