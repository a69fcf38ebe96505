#pragma once

// Code that computes with one number or with many at once. A template over a number type F is compiled
// with F = float, where each call is for one index, as on a GPU, and with F = Floats (floats.h), where
// each call is for as many indices as a vector register of the processor has floats. Both give the same
// bits.
//
// In such code a condition is a MaskOf<F>: one bool per index. Both branches are computed where any
// index needs them, and select chooses. Records read by index (at) are templates over F, too, in which
// every member has the size of F.

#include "cuda/parallel/vec.h"

#include <cmath>
#include <cstdint>
#include <span>

namespace fast {

template <class F>
struct NumberTypes;

template <>
struct NumberTypes<float> {
    using Mask = bool;
    using Word = std::uint32_t;
    template <class Enum>
    using Kind = Enum;
};

/// One truth value per index.
template <class F>
using MaskOf = typename NumberTypes<F>::Mask;

/// One std::uint32_t per index.
template <class F>
using WordOf = typename NumberTypes<F>::Word;

/// One enumerator per index.
template <class F, class Enum>
using KindOf = typename NumberTypes<F>::template Kind<Enum>;

template <class F>
using Vec3Of = glm::vec<3, F, glm::defaultp>;

// ---- One number.

HD constexpr bool any(bool mask)
{
    return mask;
}

HD constexpr bool none(bool mask)
{
    return !mask;
}

/// a where `mask`, else b.
template <class T>
HD constexpr T select(bool mask, const T& a, const T& b)
{
    return mask ? a : b;
}

/// Element `index`; a reference if there is one index.
template <class T>
HD const T& at(std::span<const T> elements, std::uint32_t index)
{
    return elements[index];
}

/// Sets element `index` where `mask`.
template <class T>
HD void put_at(std::span<T> elements, std::uint32_t index, bool mask, const T& value)
{
    if (mask) elements[index] = value;
}

HD inline float square_root(float x)
{
    return std::sqrt(x);
}

HD inline float magnitude_of(float x)
{
    return std::abs(x);
}

/// a b + c, rounded once or twice, whichever the processor does faster. So the bits differ between
/// instruction sets: only for what needs a bound on the error.
HD inline float multiply_add(float a, float b, float c)
{
#if defined(__CUDA_ARCH__) || defined(__FMA__)
    return std::fma(a, b, c);
#else
    return a * b + c;
#endif
}

/// The magnitude of x with the sign of y.
HD inline float with_sign_of(float x, float y)
{
    return std::copysign(x, y);
}

/// Of 0 <= x < 2^31, without the fraction.
HD inline std::uint32_t to_word(float x)
{
    return static_cast<std::uint32_t>(x);
}

/// The quotient x / divisor; sets `remainder`.
HD inline std::uint32_t divided(std::uint32_t x, std::uint32_t divisor, std::uint32_t& remainder)
{
    remainder = x % divisor;
    return x / divisor;
}

/// x / 2.
HD inline std::uint32_t halved(std::uint32_t x)
{
    return x >> 1;
}

/// Of x < 2^31.
HD inline float to_float(std::uint32_t x)
{
    return static_cast<float>(x);
}

HD inline bool is_finite_number(float x)
{
    return std::isfinite(x);
}

template <class F>
HD MaskOf<F> true_for_all()
{
    return true;
}

/// Names the only index there is.
struct OnlyLane {};

/// Calls function(lane) for every index of `mask`: for code that is seldom needed, or that is not worth
/// a form for many indices.
template <class Function>
HD void one_by_one(bool mask, const Function& function)
{
    if (mask) function(OnlyLane{});
}

template <class T>
HD const T& lane_of(const T& value, OnlyLane /*lane*/)
{
    return value;
}

template <class T>
HD void put_lane(T& values, OnlyLane /*lane*/, const T& value)
{
    values = value;
}

// ---- Any number of them.

/// b where b < a, else a.
template <class F>
HD F lesser(const F& a, const F& b)
{
    return select(b < a, b, a);
}

/// b where a < b, else a.
template <class F>
HD F greater(const F& a, const F& b)
{
    return select(a < b, b, a);
}

template <class F>
HD Vec3Of<F> magnitude_of(const Vec3Of<F>& v)
{
    return {magnitude_of(v.x), magnitude_of(v.y), magnitude_of(v.z)};
}

/// Whether no coordinate is infinite or NaN: for those x - x is NaN.
template <class F>
HD MaskOf<F> is_finite(const Vec3Of<F>& v)
{
    return v.x - v.x == 0.0f && v.y - v.y == 0.0f && v.z - v.z == 0.0f;
}

} // namespace fast
