#pragma once

// As many floats as a vector register of the processor has, by the Highway library, for the templates of
// number.h. Only for files that are compiled for AVX2 or better (cmake/instruction_sets.cmake).
//
// No operation is fused or approximated: each lane gets the bits that a float would get.

#include "cuda/parallel/number.h"

#include <algorithm>
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

namespace detail {

/// A record of so many members, lane by lane.
template <class Record>
constexpr std::size_t member_count = sizeof(Record) / sizeof(Words);

template <class Record>
using Members = std::array<Words, member_count<Record>>;

} // namespace detail

inline Floats select(const Mask& mask, const Floats& a, const Floats& b)
{
    return hn::IfThenElse(mask.m, a.v, b.v);
}

inline Words select(const Mask& mask, const Words& a, const Words& b)
{
    return hn::IfThenElse(hn::RebindMask(word_tag, mask.m), a.v, b.v);
}

/// Of records of Floats, Words and Kinds.
template <class Record>
Record select(const Mask& mask, const Record& a, const Record& b)
{
    const auto from_a = std::bit_cast<detail::Members<Record>>(a);
    auto result = std::bit_cast<detail::Members<Record>>(b);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = select(mask, from_a[i], result[i]);
    return std::bit_cast<Record>(result);
}

namespace detail {

/// From `first[lane]`, four words each, for the lanes k, 4 + k, 8 + k, ...: the blocks of four words
/// that a register of so many lanes consists of.
template <std::size_t lanes, class Pointers>
auto load_blocks(const Pointers& first, std::size_t k)
{
    constexpr hn::CappedTag<std::uint32_t, lanes> tag;
    if constexpr (lanes <= 4)
        return hn::LoadU(tag, first[k]);
    else
        return hn::Combine(tag, load_blocks<lanes / 2>(first, k + lanes / 2),
                           load_blocks<lanes / 2>(first, k));
}

/// From `first[lane]`, four words each: the vectors of the first, second, third and fourth words.
inline std::array<Words, 4>
load_transposed(const std::array<const std::uint32_t*, floats_at_once>& first)
{
    const auto a = load_blocks<floats_at_once>(first, 0);
    const auto b = load_blocks<floats_at_once>(first, 1);
    const auto c = load_blocks<floats_at_once>(first, 2);
    const auto d = load_blocks<floats_at_once>(first, 3);
    const auto ac_low = hn::InterleaveLower(word_tag, a, c);
    const auto bd_low = hn::InterleaveLower(word_tag, b, d);
    const auto ac_high = hn::InterleaveUpper(word_tag, a, c);
    const auto bd_high = hn::InterleaveUpper(word_tag, b, d);
    return {Words(hn::InterleaveLower(word_tag, ac_low, bd_low)),
            Words(hn::InterleaveUpper(word_tag, ac_low, bd_low)),
            Words(hn::InterleaveLower(word_tag, ac_high, bd_high)),
            Words(hn::InterleaveUpper(word_tag, ac_high, bd_high))};
}

} // namespace detail

/// Elements `index` of `elements`, whose members have 32 bits each. All lanes must have an element. (One
/// gather per member takes longer: processors load its lanes one after the other.)
template <template <class> class Record>
Record<Floats> at(std::span<const Record<float>> elements, const Words& index)
{
    constexpr std::size_t members = detail::member_count<Record<Floats>>;
    static_assert(sizeof(Record<float>) == 4 * members && members >= 4);
    alignas(HWY_MAX_BYTES) std::array<std::uint32_t, floats_at_once> places;
    hn::Store(index.v, word_tag, places.data());
    const auto* const first = reinterpret_cast<const std::uint32_t*>(elements.data());
    std::array<const std::uint32_t*, floats_at_once> rows;
    detail::Members<Record<Floats>> result;
    for (std::size_t done = 0; done < members; done += 4) {
        // The last four members overlap with those before: nothing is read behind the element.
        const std::size_t from = std::min(done, members - 4);
        for (std::size_t lane = 0; lane < floats_at_once; ++lane)
            rows[lane] = first + places[lane] * members + from;
        const std::array<Words, 4> four = detail::load_transposed(rows);
        for (std::size_t i = 0; i < 4; ++i) result[from + i] = four[i];
    }
    return std::bit_cast<Record<Floats>>(result);
}

inline Words at(std::span<const std::uint32_t> elements, const Words& index)
{
    const auto* const first = reinterpret_cast<const std::int32_t*>(elements.data());
    return hn::BitCast(word_tag, hn::GatherIndex(int_tag, first, hn::BitCast(int_tag, index.v)));
}

inline Floats at(std::span<const float> elements, const Words& index)
{
    return hn::GatherIndex(float_tag, elements.data(), hn::BitCast(int_tag, index.v));
}

namespace detail {

/// The same type for one index.
template <class Record>
struct One;
template <template <class> class Record>
struct One<Record<Floats>> {
    using Type = Record<float>;
};
template <>
struct One<Vec3Of<Floats>> {
    using Type = Vec3;
};
template <>
struct One<Floats> {
    using Type = float;
};
template <>
struct One<Words> {
    using Type = std::uint32_t;
};

} // namespace detail

/// One lane of a number, vector or record.
template <class Record>
typename detail::One<Record>::Type lane_of(const Record& record, int lane)
{
    using One = typename detail::One<Record>::Type;
    const auto members = std::bit_cast<detail::Members<Record>>(record);
    alignas(alignof(One)) std::array<std::uint32_t, detail::member_count<Record>> result;
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = hn::ExtractLane(members[i].v, static_cast<std::size_t>(lane));
    return std::bit_cast<One>(result);
}

/// Replaces one lane.
template <class Record>
void put_lane(Record& record, int lane, const typename detail::One<Record>::Type& value)
{
    const auto words = std::bit_cast<std::array<std::uint32_t, detail::member_count<Record>>>(value);
    auto members = std::bit_cast<detail::Members<Record>>(record);
    for (std::size_t i = 0; i < words.size(); ++i)
        members[i] = hn::InsertLane(members[i].v, static_cast<std::size_t>(lane), words[i]);
    record = std::bit_cast<Record>(members);
}

inline void put_lane(Mask& mask, int lane, bool value)
{
    const Words lanes = hn::Iota(word_tag, 0);
    const Mask only = lanes == Words(static_cast<std::uint32_t>(lane));
    mask = value ? mask || only : mask && !only;
}

/// Calls function(lane) for the lanes of `mask`, in their order.
template <class Function>
void one_by_one(const Mask& mask, const Function& function)
{
    for (std::uint32_t bits = bits_of(mask); bits != 0; bits &= bits - 1)
        function(std::countr_zero(bits));
}

/// Sets the elements of `index` where `mask`. If an index occurs twice, the last lane counts.
template <template <class> class Record>
void put_at(std::span<Record<float>> elements, const Words& index, const Mask& mask,
            const Record<Floats>& value)
{
    constexpr std::size_t members = detail::member_count<Record<Floats>>;
    const auto record = std::bit_cast<detail::Members<Record<Floats>>>(value);
    alignas(HWY_MAX_BYTES) std::array<std::array<std::uint32_t, floats_at_once>, members> words;
    alignas(HWY_MAX_BYTES) std::array<std::uint32_t, floats_at_once> places;
    for (std::size_t i = 0; i < members; ++i) hn::Store(record[i].v, word_tag, words[i].data());
    hn::Store(index.v, word_tag, places.data());
    one_by_one(mask, [&](int lane) {
        std::array<std::uint32_t, members> one;
        for (std::size_t i = 0; i < members; ++i) one[i] = words[i][static_cast<std::size_t>(lane)];
        elements[places[static_cast<std::size_t>(lane)]] = std::bit_cast<Record<float>>(one);
    });
}

inline void put_at(std::span<std::uint32_t> elements, const Words& index, const Mask& mask,
                   const Words& value)
{
    one_by_one(mask, [&](int lane) { elements[lane_of(index, lane)] = lane_of(value, lane); });
}

/// The quotient x / divisor; sets `remainder`.
inline Words divided(const Words& x, std::uint32_t divisor, Words& remainder)
{
    Words quotient;
    if (divisor >> 22 != 0 || any(Words(hn::ShiftRight<22>(x.v)) != Words(0u))) {
        one_by_one(Mask(true), [&](int lane) {
            put_lane(quotient, lane, lane_of(x, lane) / divisor);
            put_lane(remainder, lane, lane_of(x, lane) % divisor);
        });
        return quotient;
    }
    // For numbers below 2^22 the estimate from floats errs by one at most, in either direction.
    const Words estimate = to_word(to_float(x) * (1.0f / static_cast<float>(divisor)));
    quotient = select(x < estimate * divisor, estimate - 1u, estimate);
    remainder = x - quotient * divisor;
    const Mask one_more = remainder >= Words(divisor);
    quotient = select(one_more, quotient + 1u, quotient);
    remainder = select(one_more, remainder - divisor, remainder);
    return quotient;
}

} // namespace fast

/// GLM asks whether a number is of the IEEE's kind.
template <>
class std::numeric_limits<fast::Floats> : public std::numeric_limits<float> {};
