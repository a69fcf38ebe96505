#pragma once

// The stages (path_stages.h) for many indices at once.

#include "cuda/parallel/floats_records.h"
#include "cuda/stages/rows.h"

#include <algorithm>

namespace fast {

/// `count` neighbouring indices, at most floats_at_once.
struct FloatsAt {
    std::uint32_t first;
    std::uint32_t count;
};

inline Mask active_at(const FloatsAt& index)
{
    return first_lanes(index.count);
}

inline Words index_of(const FloatsAt& index)
{
    return hn::Iota(word_tag, index.first);
}

template <>
struct NumberAt<FloatsAt> {
    using Type = Floats;
};

/// The records at these indices. Lanes that are not active have some record, or zeros.
template <template <class> class Record>
Record<Floats> load(const Rows<Record>& rows, const FloatsAt& index)
{
    detail::Members<Record<Floats>> record;
    const auto mask = hn::FirstN(word_tag, index.count);
    for (std::size_t i = 0; i < record.size(); ++i)
        record[i] = hn::MaskedLoad(mask, word_tag, rows.member(i) + index.first);
    return std::bit_cast<Record<Floats>>(record);
}

template <template <class> class Record>
void store(const Rows<Record>& rows, const FloatsAt& index, const Record<Floats>& value)
{
    const auto record = std::bit_cast<detail::Members<Record<Floats>>>(value);
    for (std::size_t i = 0; i < record.size(); ++i)
        hn::StoreU(record[i].v, word_tag, rows.member(i) + index.first);
}

namespace detail {

/// For each mask of eight lanes: the lanes that are in it, from the lowest on, then zeros.
constexpr auto lanes_of_masks = [] {
    std::array<std::array<std::uint8_t, 8>, 256> lanes{};
    for (std::size_t mask = 0; mask < 256; ++mask)
        for (std::size_t lane = 0, count = 0; lane < 8; ++lane)
            if ((mask >> lane & 1) != 0) lanes[mask][count++] = static_cast<std::uint8_t>(lane);
    return lanes;
}();

/// Moves the lanes of a mask to the front of registers, in their order. AVX-512 has an instruction for
/// it. With AVX2, hn::Compress would look up the order again for each register, in a table of 1 KB that
/// g++ 12 copies each time.
class ToFront {
public:
    explicit ToFront(const Mask& mask) : mask_(hn::RebindMask(word_tag, mask.m))
    {
        if constexpr (floats_at_once == 8) {
            constexpr hn::Rebind<std::uint8_t, decltype(word_tag)> byte_tag;
            order_ = hn::PromoteTo(word_tag, hn::LoadU(byte_tag, lanes_of_masks[bits_of(mask)].data()));
        }
    }
    [[nodiscard]] Words operator()(const Words& lanes) const
    {
        if constexpr (floats_at_once == 8)
            return hn::TableLookupLanes(lanes.v, hn::IndicesFromVec(word_tag, order_.v));
        else
            return hn::Compress(lanes.v, mask_);
    }

private:
    hn::Mask<decltype(word_tag)> mask_;
    Words order_;
};

} // namespace detail

/// Appends the records where `mask`. Only one thread may use the queue.
template <template <class> class Record>
void push(const Queue<Record>& queue, const Mask& mask, const Record<Floats>& value)
{
    const auto record = std::bit_cast<detail::Members<Record<Floats>>>(value);
    const detail::ToFront to_front(mask);
    const std::uint32_t end = *queue.count;
    for (std::size_t i = 0; i < record.size(); ++i)
        hn::StoreU(to_front(record[i]).v, word_tag, queue.rows.member(i) + end);
    *queue.count = end + static_cast<std::uint32_t>(hn::CountTrue(float_tag, mask.m));
}

/// Runs stages on the calling thread, for many indices at once.
class FloatsExecutor {
public:
    template <class Stage>
    void operator()(std::uint32_t count, const Stage& stage) const
    {
        for (std::uint32_t first = 0; first < count; first += floats_at_once)
            stage(FloatsAt{first, std::min(floats_at_once, count - first)});
    }
};

} // namespace fast
