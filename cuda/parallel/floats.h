#pragma once

// As many floats as a vector register of the processor has, by the Highway library, for the templates of
// number.h. Only for files that are compiled for AVX2 or better (cmake/instruction_sets.cmake).
//
// No operation is fused or approximated: each lane gets the bits that a float would get.

#include "cuda/parallel/number.h"

#include <array>
#include <bit>
#include <cstdint>
#include <hwy/highway.h>
#include <limits>
#include <span>

namespace fast {

namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::ScalableTag<float> float_tag;
constexpr hn::ScalableTag<std::int32_t> int_tag;
constexpr hn::ScalableTag<std::uint32_t> word_tag;

/// The floats of a register.
constexpr std::uint32_t floats_at_once = HWY_MAX_BYTES / 4;

/// One truth value per lane.
struct Mask {
    hn::Mask<decltype(float_tag)> m;

    Mask() = default;
    Mask(hn::Mask<decltype(float_tag)> lanes) : m(lanes) {}
    Mask(bool all)
        : m(hn::RebindMask(float_tag, hn::Ne(hn::Set(word_tag, all ? 1u : 0u), hn::Zero(word_tag))))
    {}

    friend Mask operator&&(Mask a, Mask b) { return {hn::And(a.m, b.m)}; }
    friend Mask operator||(Mask a, Mask b) { return {hn::Or(a.m, b.m)}; }
    friend Mask operator!(Mask a) { return {hn::Not(a.m)}; }
};

inline bool any(Mask mask)
{
    return !hn::AllFalse(float_tag, mask.m);
}

inline bool none(Mask mask)
{
    return hn::AllFalse(float_tag, mask.m);
}

/// Bit i belongs to lane i.
inline std::uint32_t bits_of(Mask mask)
{
    std::array<std::uint8_t, 8> bytes{};
    hn::StoreMaskBits(float_tag, mask.m, bytes.data());
    return std::bit_cast<std::array<std::uint32_t, 2>>(bytes)[0];
}

/// The inverse.
inline Mask mask_of_bits(std::uint32_t bits)
{
    const auto bytes = std::bit_cast<std::array<std::uint8_t, 8>>(std::array<std::uint32_t, 2>{bits, 0});
    return {hn::LoadMaskBits(float_tag, bytes.data())};
}

/// The first `count` lanes.
inline Mask first_lanes(std::uint32_t count)
{
    return {hn::FirstN(float_tag, count)};
}

struct Floats {
    hn::Vec<decltype(float_tag)> v;

    Floats() = default;
    Floats(hn::Vec<decltype(float_tag)> lanes) : v(lanes) {}
    Floats(float x) : v(hn::Set(float_tag, x)) {}

    Floats& operator+=(const Floats& b) { return *this = *this + b; }
    Floats& operator-=(const Floats& b) { return *this = *this - b; }
    Floats& operator*=(const Floats& b) { return *this = *this * b; }
    Floats& operator/=(const Floats& b) { return *this = *this / b; }

    friend Floats operator+(const Floats& a, const Floats& b) { return hn::Add(a.v, b.v); }
    friend Floats operator-(const Floats& a, const Floats& b) { return hn::Sub(a.v, b.v); }
    friend Floats operator*(const Floats& a, const Floats& b) { return hn::Mul(a.v, b.v); }
    friend Floats operator/(const Floats& a, const Floats& b) { return hn::Div(a.v, b.v); }
    friend Floats operator-(const Floats& a) { return hn::Neg(a.v); }
    friend Mask operator<(const Floats& a, const Floats& b) { return {hn::Lt(a.v, b.v)}; }
    friend Mask operator>(const Floats& a, const Floats& b) { return {hn::Gt(a.v, b.v)}; }
    friend Mask operator<=(const Floats& a, const Floats& b) { return {hn::Le(a.v, b.v)}; }
    friend Mask operator>=(const Floats& a, const Floats& b) { return {hn::Ge(a.v, b.v)}; }
    friend Mask operator==(const Floats& a, const Floats& b) { return {hn::Eq(a.v, b.v)}; }
    friend Mask operator!=(const Floats& a, const Floats& b) { return {hn::Ne(a.v, b.v)}; }
};

/// One std::uint32_t per lane.
struct Words {
    hn::Vec<decltype(word_tag)> v;

    Words() = default;
    Words(hn::Vec<decltype(word_tag)> lanes) : v(lanes) {}
    Words(std::uint32_t x) : v(hn::Set(word_tag, x)) {}

    friend Words operator+(const Words& a, const Words& b) { return hn::Add(a.v, b.v); }
    friend Words operator-(const Words& a, const Words& b) { return hn::Sub(a.v, b.v); }
    friend Words operator*(const Words& a, const Words& b) { return hn::Mul(a.v, b.v); }
    friend Words operator^(const Words& a, const Words& b) { return hn::Xor(a.v, b.v); }
    friend Words operator&(const Words& a, const Words& b) { return hn::And(a.v, b.v); }
    friend Words operator|(const Words& a, const Words& b) { return hn::Or(a.v, b.v); }
    friend Mask operator==(const Words& a, const Words& b)
    {
        return {hn::RebindMask(float_tag, hn::Eq(a.v, b.v))};
    }
    friend Mask operator!=(const Words& a, const Words& b) { return !(a == b); }
    /// As signed numbers: for words < 2^31.
    friend Mask operator<(const Words& a, const Words& b)
    {
        return {hn::RebindMask(float_tag, hn::Lt(hn::BitCast(int_tag, a.v), hn::BitCast(int_tag, b.v)))};
    }
    friend Mask operator>=(const Words& a, const Words& b) { return !(a < b); }
};

/// One enumerator per lane.
template <class Enum>
struct Kinds {
    Words words;

    Kinds() = default;
    Kinds(Enum kind) : words(static_cast<std::uint32_t>(kind)) {}
    friend Mask operator==(const Kinds& a, Enum b)
    {
        return a.words == Words(static_cast<std::uint32_t>(b));
    }
};

template <>
struct NumberTypes<Floats> {
    using Mask = fast::Mask;
    using Word = Words;
    template <class Enum>
    using Kind = Kinds<Enum>;
};

inline Floats square_root(const Floats& x)
{
    return hn::Sqrt(x.v);
}

/// GLM calls this.
inline Floats sqrt(const Floats& x)
{
    return hn::Sqrt(x.v);
}

inline Floats magnitude_of(const Floats& x)
{
    return hn::Abs(x.v);
}

inline Floats multiply_add(const Floats& a, const Floats& b, const Floats& c)
{
    return hn::MulAdd(a.v, b.v, c.v);
}

inline Floats with_sign_of(const Floats& x, const Floats& y)
{
    return hn::CopySign(x.v, y.v);
}

inline Words to_word(const Floats& x)
{
    return hn::BitCast(word_tag, hn::ConvertTo(int_tag, x.v));
}

inline Words halved(const Words& x)
{
    return hn::ShiftRight<1>(x.v);
}

inline Floats to_float(const Words& x)
{
    return hn::ConvertTo(float_tag, hn::BitCast(int_tag, x.v));
}

inline Mask is_finite_number(const Floats& x)
{
    return {hn::IsFinite(x.v)};
}

inline Floats select(const Mask& mask, const Floats& a, const Floats& b)
{
    return hn::IfThenElse(mask.m, a.v, b.v);
}

/// As in number.h. These instructions return their second operand where one operand is NaN or both are
/// 0.
inline Floats lesser(const Floats& a, const Floats& b)
{
    return hn::Min(b.v, a.v);
}

inline Floats greater(const Floats& a, const Floats& b)
{
    return hn::Max(b.v, a.v);
}

inline Words select(const Mask& mask, const Words& a, const Words& b)
{
    return hn::IfThenElse(hn::RebindMask(word_tag, mask.m), a.v, b.v);
}

/// Calls function(lane) for the lanes of `mask`, in their order.
template <class Function>
void one_by_one(const Mask& mask, const Function& function)
{
    for (std::uint32_t bits = bits_of(mask); bits != 0; bits &= bits - 1)
        function(std::countr_zero(bits));
}

} // namespace fast

/// GLM asks whether a number is of the IEEE's kind.
template <>
class std::numeric_limits<fast::Floats> : public std::numeric_limits<float> {};
