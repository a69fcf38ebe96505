#pragma once

// Pairs of keys and values, and the memory to sort them.

#include "cuda/parallel/buffer.h"
#include "cuda/parallel/executor.h"
#include "cuda/parallel/radix_sort.h"

#include <array>
#include <cstdint>
#include <span>

namespace fast {

/// Sorting again allocates nothing.
template <class Key>
class SortedPairs {
public:
    /// For up to `capacity` pairs whose keys have so many bits. Throws OutOfMemory.
    template <Executor E>
    SortedPairs(Memory& memory, const E& executor, std::uint32_t capacity, int bits)
        : bits_(bits), keys_{Buffer<Key>(memory, capacity), Buffer<Key>(memory, capacity)},
          values_{Buffer<std::uint32_t>(memory, capacity), Buffer<std::uint32_t>(memory, capacity)},
          scratch_(memory, sort_scratch<Key, std::uint32_t>(executor, capacity, bits))
    {}
    /// Queues the sort of the first `count` pairs.
    template <Executor E>
    void sort(E& executor, std::uint32_t count)
    {
        Alternating<Key> keys{keys_[0].first(count), keys_[1].first(count)};
        Alternating<std::uint32_t> values{values_[0].first(count), values_[1].first(count)};
        radix_sort(executor, keys, values, bits_, scratch_.all());
        sorted_keys_ = keys.current;
        sorted_values_ = values.current;
    }
    [[nodiscard]] std::size_t capacity() const { return keys_[0].size(); }
    // To be filled before the sort.
    [[nodiscard]] std::span<Key> keys() { return keys_[0].all(); }
    [[nodiscard]] std::span<std::uint32_t> values() { return values_[0].all(); }
    // Those of the last sort.
    [[nodiscard]] std::span<const Key> sorted_keys() const { return sorted_keys_; }
    [[nodiscard]] std::span<const std::uint32_t> sorted_values() const { return sorted_values_; }

private:
    int bits_;
    std::array<Buffer<Key>, 2> keys_;
    std::array<Buffer<std::uint32_t>, 2> values_;
    std::span<const Key> sorted_keys_;
    std::span<const std::uint32_t> sorted_values_;
    Buffer<std::uint32_t> scratch_;
};

} // namespace fast
