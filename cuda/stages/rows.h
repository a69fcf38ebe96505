#pragma once

// Arrays of records, member by member (structure of arrays), so that neighbouring indices read and write
// neighbouring words; and queues of them.

#include "cuda/parallel/atomic.h"
#include "cuda/parallel/number.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>

namespace fast {

// ---- One index. The forms for many are in floats_rows.h.

/// The number type of a stage's index.
template <class Index>
struct NumberAt;
template <>
struct NumberAt<std::uint32_t> {
    using Type = float;
};
template <class Index>
using NumberTypeAt = typename NumberAt<Index>::Type;

HD constexpr bool active_at(std::uint32_t /*index*/)
{
    return true;
}

HD constexpr std::uint32_t index_of(std::uint32_t index)
{
    return index;
}

/// `capacity` records whose members have 32 bits each.
template <template <class> class Record>
class Rows {
public:
    static constexpr std::size_t members = sizeof(Record<float>) / sizeof(std::uint32_t);
    /// The words that so many records need. Writing many records at once may write up to `spare` words
    /// behind the last one of each member.
    static constexpr std::uint32_t spare = 16;
    static constexpr std::size_t words_for(std::uint32_t capacity)
    {
        return members * (std::size_t{capacity} + spare);
    }

    Rows() = default;
    /// `words`: words_for(capacity) of them.
    HD Rows(std::span<std::uint32_t> words, std::uint32_t capacity)
        : words_(words.data()), stride_(capacity + spare)
    {}

    /// The array of member i.
    [[nodiscard]] HD std::uint32_t* member(std::size_t i) const { return words_ + i * stride_; }

private:
    std::uint32_t* words_ = nullptr;
    std::size_t stride_ = 0;
};

template <template <class> class Record>
HD Record<float> load(const Rows<Record>& rows, std::uint32_t index)
{
    std::array<std::uint32_t, Rows<Record>::members> record;
    for (std::size_t i = 0; i < record.size(); ++i) record[i] = rows.member(i)[index];
    return std::bit_cast<Record<float>>(record);
}

template <template <class> class Record>
HD void store(const Rows<Record>& rows, std::uint32_t index, const Record<float>& value)
{
    const auto record = std::bit_cast<std::array<std::uint32_t, Rows<Record>::members>>(value);
    for (std::size_t i = 0; i < record.size(); ++i) rows.member(i)[index] = record[i];
}

/// Rows that are filled from the front. The order of the records depends on the schedule.
template <template <class> class Record>
struct Queue {
    Rows<Record> rows;
    std::uint32_t* count;
};

/// Appends `value` where `mask`. May be called from any number of threads.
template <template <class> class Record>
HD void push(const Queue<Record>& queue, bool mask, const Record<float>& value)
{
    if (mask) store(queue.rows, next_number(*queue.count), value);
}

} // namespace fast
