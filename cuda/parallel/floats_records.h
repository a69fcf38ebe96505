#pragma once

// Records of Floats, Words and Kinds: chosen lane by lane, read and written by index, one lane at a
// time. A record is seen as an array of registers, one per member.

#include "cuda/parallel/floats.h"

#include <algorithm>

namespace fast {

namespace detail {

/// A record of so many members, lane by lane.
template <class Record>
constexpr std::size_t member_count = sizeof(Record) / sizeof(Words);

template <class Record>
using Members = std::array<Words, member_count<Record>>;

} // namespace detail

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

/// Floats or Words in memory, for code that reads and writes single lanes: lane_of and put_lane store
/// and load all lanes each time.
template <class Number>
class StoredLanes {
    using One = typename detail::One<Number>::Type;

public:
    StoredLanes() = default; // undefined
    explicit StoredLanes(const Number& number) { *this = number; }
    StoredLanes& operator=(const Number& number)
    {
        hn::Store(std::bit_cast<Words>(number).v, word_tag, words_.data());
        return *this;
    }
    [[nodiscard]] Number all() const
    {
        return std::bit_cast<Number>(Words(hn::Load(word_tag, words_.data())));
    }
    [[nodiscard]] One operator[](int lane) const
    {
        return std::bit_cast<One>(words_[static_cast<std::size_t>(lane)]);
    }
    void put(int lane, One value)
    {
        words_[static_cast<std::size_t>(lane)] = std::bit_cast<std::uint32_t>(value);
    }

private:
    alignas(HWY_MAX_BYTES) std::array<std::uint32_t, floats_at_once> words_;
};

inline void put_lane(Mask& mask, int lane, bool value)
{
    const Words lanes = hn::Iota(word_tag, 0);
    const Mask only = lanes == Words(static_cast<std::uint32_t>(lane));
    mask = value ? mask || only : mask && !only;
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
