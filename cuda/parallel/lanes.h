#pragma once

// Eight floats, added, multiplied and compared lane by lane. On the host they are one or two vector
// registers, by the vector extension of g++ and clang, which runs on every processor and uses the widest
// instructions that a file is compiled for. For nvcc they are an array, because on a GPU each thread
// computes one float at a time.

#include "cuda/parallel/host_device.h"
#include "cuda/parallel/number.h"

#include <bit>
#include <cstdint>
#include <cstring>

#if !defined(__CUDACC__) && defined(__SSE__)
#include <immintrin.h>
#endif

namespace fast {

constexpr int lane_count = 8;

/// Bit i belongs to lane i.
using LaneBits = std::uint32_t;

#if defined(__CUDACC__)

/// Whether all lanes take as long as one.
constexpr bool lanes_at_once = false;

struct alignas(32) Lanes { // same layout in memory as the host's Lanes
    float lane[lane_count];

    HD float operator[](int i) const { return lane[i]; }
    HD float& operator[](int i) { return lane[i]; }
};

namespace detail {

/// The lanes function(i).
template <class Function>
HD Lanes each_lane(const Function& function)
{
    Lanes result;
    for (int i = 0; i < lane_count; ++i) result[i] = function(i);
    return result;
}

} // namespace detail

HD inline Lanes all_lanes(float x)
{
    return detail::each_lane([&](int) { return x; });
}

HD inline Lanes operator-(const Lanes& a, const Lanes& b)
{
    return detail::each_lane([&](int i) { return a[i] - b[i]; });
}

HD inline Lanes operator+(const Lanes& a, const Lanes& b)
{
    return detail::each_lane([&](int i) { return a[i] + b[i]; });
}

HD inline Lanes operator*(const Lanes& a, const Lanes& b)
{
    return detail::each_lane([&](int i) { return a[i] * b[i]; });
}

/// a b + c, as multiply_add of number.h.
HD inline Lanes multiply_add(const Lanes& a, const Lanes& b, const Lanes& c)
{
    return detail::each_lane([&](int i) { return multiply_add(a[i], b[i], c[i]); });
}

/// a where a > b, else b; so b where one of them is NaN.
HD inline Lanes larger(const Lanes& a, const Lanes& b)
{
    return detail::each_lane([&](int i) { return a[i] > b[i] ? a[i] : b[i]; });
}

/// a where a < b, else b; so b where one of them is NaN.
HD inline Lanes smaller(const Lanes& a, const Lanes& b)
{
    return detail::each_lane([&](int i) { return a[i] < b[i] ? a[i] : b[i]; });
}

HD inline Lanes operator-(const Lanes& a)
{
    return detail::each_lane([&](int i) { return -a[i]; });
}

/// Where a <= b; not where one of them is NaN.
HD inline LaneBits not_above(const Lanes& a, const Lanes& b)
{
    LaneBits bits = 0;
    for (int i = 0; i < lane_count; ++i) bits |= a[i] <= b[i] ? 1u << i : 0u;
    return bits;
}

/// x where a < b, else y.
HD inline Lanes where_below(const Lanes& a, const Lanes& b, const Lanes& x, const Lanes& y)
{
    return detail::each_lane([&](int i) { return a[i] < b[i] ? x[i] : y[i]; });
}

#else

constexpr bool lanes_at_once = true;

namespace detail {

#if defined(__AVX__)
constexpr int register_lanes = 8;
#else
constexpr int register_lanes = 4; // wider vectors would be passed in other ways than with AVX
#endif
using Register = float __attribute__((vector_size(4 * register_lanes)));

} // namespace detail

struct Lanes {
    detail::Register parts[lane_count / detail::register_lanes];

    float operator[](int i) const
    {
        return parts[i / detail::register_lanes][i % detail::register_lanes];
    }
    float& operator[](int i)
    {
        return reinterpret_cast<float*>(parts)[i]; // a vector may be accessed as its elements
    }
};

namespace detail {

/// The lanes whose registers are function(i).
template <class Function>
Lanes each_register(const Function& function)
{
    Lanes result;
    for (int i = 0; i < lane_count / register_lanes; ++i) result.parts[i] = function(i);
    return result;
}

} // namespace detail

inline Lanes all_lanes(float x)
{
    return detail::each_register([&](int) { return x - detail::Register{}; });
}

inline Lanes operator+(const Lanes& a, const Lanes& b)
{
    return detail::each_register([&](int i) { return a.parts[i] + b.parts[i]; });
}

inline Lanes operator-(const Lanes& a, const Lanes& b)
{
    return detail::each_register([&](int i) { return a.parts[i] - b.parts[i]; });
}

inline Lanes operator*(const Lanes& a, const Lanes& b)
{
    return detail::each_register([&](int i) { return a.parts[i] * b.parts[i]; });
}

inline Lanes operator-(const Lanes& a)
{
    return detail::each_register([&](int i) { return -a.parts[i]; });
}

/// a b + c, as multiply_add of number.h.
inline Lanes multiply_add(const Lanes& a, const Lanes& b, const Lanes& c)
{
#if defined(__FMA__)
    Lanes result;
    result.parts[0] = _mm256_fmadd_ps(a.parts[0], b.parts[0], c.parts[0]);
    return result;
#else
    return a * b + c;
#endif
}

/// a where a > b, else b; so b where one of them is NaN.
inline Lanes larger(const Lanes& a, const Lanes& b)
{
#if defined(__AVX__)
    return {{_mm256_max_ps(a.parts[0], b.parts[0])}}; // g++ takes two instructions if b is 0
#else
    return detail::each_register(
        [&](int i) { return a.parts[i] > b.parts[i] ? a.parts[i] : b.parts[i]; });
#endif
}

/// a where a < b, else b; so b where one of them is NaN.
inline Lanes smaller(const Lanes& a, const Lanes& b)
{
    return detail::each_register(
        [&](int i) { return a.parts[i] < b.parts[i] ? a.parts[i] : b.parts[i]; });
}

/// x where a < b, else y.
inline Lanes where_below(const Lanes& a, const Lanes& b, const Lanes& x, const Lanes& y)
{
    return detail::each_register(
        [&](int i) { return a.parts[i] < b.parts[i] ? x.parts[i] : y.parts[i]; });
}

/// Where a <= b; not where one of them is NaN.
inline LaneBits not_above(const Lanes& a, const Lanes& b)
{
#if defined(__AVX__)
    return static_cast<LaneBits>(_mm256_movemask_ps(std::bit_cast<__m256>(a.parts[0] <= b.parts[0])));
#elif defined(__SSE__)
    return static_cast<LaneBits>(_mm_movemask_ps(std::bit_cast<__m128>(a.parts[0] <= b.parts[0])) |
                                 _mm_movemask_ps(std::bit_cast<__m128>(a.parts[1] <= b.parts[1])) << 4);
#else
    LaneBits bits = 0;
    for (int i = 0; i < lane_count; ++i) bits |= a[i] <= b[i] ? 1u << i : 0u;
    return bits;
#endif
}

#endif

/// Eight floats from memory, aligned as one float.
HD inline Lanes load_lanes(const float* from)
{
    Lanes result;
    std::memcpy(&result, from, sizeof result);
    return result;
}

/// The inverse.
HD inline void store_lanes(const Lanes& lanes, float* to)
{
    std::memcpy(to, &lanes, sizeof lanes);
}

/// Where a >= 0; not where a is NaN.
HD inline LaneBits non_negative(const Lanes& a)
{
    return not_above(all_lanes(0.0f), a);
}

/// The absolute value.
HD inline Lanes magnitude(const Lanes& a)
{
#if defined(__AVX__) && !defined(__CUDACC__)
    return {{_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.parts[0])}};
#else
    return larger(a, -a);
#endif
}

/// The number of the lowest lane in `bits`, and takes it out of them. If there is none: -1 or a number
/// of no lane.
HD inline int take_lane(LaneBits& bits)
{
#if defined(__CUDA_ARCH__)
    const int lane = __ffs(static_cast<int>(bits)) - 1;
#else
    const int lane = std::countr_zero(bits);
#endif
    bits &= bits - 1;
    return lane;
}

} // namespace fast
