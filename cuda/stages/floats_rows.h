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

/// Appends the records where `mask`. Only one thread may use the queue.
template <template <class> class Record>
void push(const Queue<Record>& queue, const Mask& mask, const Record<Floats>& value)
{
    const auto record = std::bit_cast<detail::Members<Record<Floats>>>(value);
    const auto wanted = hn::RebindMask(word_tag, mask.m);
    for (std::size_t i = 0; i < record.size(); ++i)
        hn::StoreU(hn::Compress(record[i].v, wanted), word_tag, queue.rows.member(i) + *queue.count);
    *queue.count += static_cast<std::uint32_t>(hn::CountTrue(float_tag, mask.m));
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
