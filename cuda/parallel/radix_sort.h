#pragma once

// A stable sort of pairs by the bits of their keys, digit by digit, the least significant first. On a
// device CUB does it (primitives.cuh); this file is for the executors of the host. It launches three
// short kernels per digit, so that the same executors test it as test everything else.
// std::sort(std::execution::par) would use its own thread pool, compare whole keys, and not be stable.

#include "cuda/parallel/chunks.h"
#include "cuda/parallel/executor.h"

#include <cstddef>
#include <span>
#include <utility>

namespace fast {

/// An array with valid contents, and another of the same size for temporary use.
template <class T>
struct Alternating {
    std::span<T> current;
    std::span<T> other;

    void swap() { std::swap(current, other); }
};

/// Digit number `shift / bits` of keys.
struct Digit {
    int shift;
    int bits;

    [[nodiscard]] HD std::uint32_t values() const { return 1u << bits; }
    template <class Key>
    [[nodiscard]] HD std::uint32_t of(Key key) const
    {
        return static_cast<std::uint32_t>(key >> shift) & (values() - 1);
    }
};

/// Kernel over chunks: counts how often each value of the digit occurs among the keys of a chunk.
template <class Key>
struct CountDigits {
    Chunks chunks;
    Digit digit;
    std::span<const Key> keys;
    std::span<std::uint32_t> counts; // [chunk][value]

    HD void operator()(std::uint32_t chunk) const
    {
        const auto mine = counts.subspan(std::size_t{chunk} * digit.values(), digit.values());
        for (std::uint32_t& count : mine) count = 0;
        for (std::uint32_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i)
            ++mine[digit.of(keys[i])];
    }
};

/// Kernel of one index: turns the counts into the places of the first key of each value and chunk.
/// Smaller values go first; within one value, earlier chunks go first.
struct PlaceDigits {
    std::uint32_t chunks;
    std::uint32_t values;
    std::span<std::uint32_t> counts; // [chunk][value]

    HD void operator()(std::uint32_t /*index*/) const
    {
        std::uint32_t sum = 0;
        for (std::uint32_t value = 0; value < values; ++value)
            for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
                std::uint32_t& count = counts[std::size_t{chunk} * values + value];
                const std::uint32_t place = sum;
                sum += count;
                count = place;
            }
    }
};

/// Kernel over chunks: moves the pairs of a chunk to their places, in order.
template <class Key, class Value>
struct MoveByDigit {
    Chunks chunks;
    Digit digit;
    Alternating<Key> keys;
    Alternating<Value> values;
    std::span<std::uint32_t> places; // [chunk][value]

    HD void operator()(std::uint32_t chunk) const
    {
        const auto mine = places.subspan(std::size_t{chunk} * digit.values(), digit.values());
        for (std::uint32_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i) {
            const std::uint32_t to = mine[digit.of(keys.current[i])]++;
            keys.other[to] = keys.current[i];
            values.other[to] = values.current[i];
        }
    }
};

/// The largest number of bits of a digit: the counters of one digit fit into the first-level cache.
constexpr int most_digit_bits = 11;

/// The number of 32-bit words of scratch memory that `radix_sort` needs for `count` pairs.
template <class Key, class Value, HostExecutor E>
std::size_t sort_scratch(const E& executor, std::uint32_t /*count*/, int /*bits*/)
{
    return std::size_t{executor.width()} << most_digit_bits;
}

/// Sorts the pairs (keys.current[i], values.current[i]) by the lowest `bits` bits of their keys; all
/// higher bits must be 0. Equal keys keep their order. The result is in `current`, which may then be
/// the array that was `other` before.
template <HostExecutor E, class Key, class Value>
void radix_sort(E& executor, Alternating<Key>& keys, Alternating<Value>& values, int bits,
                std::span<std::uint32_t> scratch)
{
    const int digits = (bits + most_digit_bits - 1) / most_digit_bits;
    const int digit_bits = (bits + digits - 1) / digits;
    const Chunks chunks{static_cast<std::uint32_t>(keys.current.size()), executor.width()};
    for (int shift = 0; shift < bits; shift += digit_bits) {
        const Digit digit{shift, digit_bits};
        executor(chunks.chunks, CountDigits<Key>{chunks, digit, keys.current, scratch});
        executor(1, PlaceDigits{chunks.chunks, digit.values(), scratch});
        executor(chunks.chunks, MoveByDigit<Key, Value>{chunks, digit, keys, values, scratch});
        keys.swap();
        values.swap();
    }
}

} // namespace fast
