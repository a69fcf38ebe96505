// Reduction and sort on the executors of the host. (A device uses CUB for both: lbvh_test.cpp
// compares.)

#include "cuda/parallel/radix_sort.h"
#include "cuda/parallel/reduce.h"
#include "cuda/parallel/threaded_executor.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace {

/// Sorts on an executor; returns keys and values.
template <class Key, fast::Executor E>
std::pair<std::vector<Key>, std::vector<std::uint32_t>> sorted(E& executor, std::vector<Key> keys,
                                                               int bits)
{
    std::vector<std::uint32_t> values(keys.size());
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = i;
    std::vector<Key> keys_beside(keys.size());
    std::vector<std::uint32_t> values_beside(keys.size());
    std::vector<std::uint32_t> scratch(
        fast::sort_scratch<Key, std::uint32_t>(executor, static_cast<std::uint32_t>(keys.size()), bits));
    fast::Alternating<Key> k{keys, keys_beside};
    fast::Alternating<std::uint32_t> v{values, values_beside};
    radix_sort(executor, k, v, bits, scratch);
    return {{k.current.begin(), k.current.end()}, {v.current.begin(), v.current.end()}};
}

template <class Key>
void expect_stable_sort(std::uint32_t threads)
{
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const int bits = *rc::gen::inRange(1, std::numeric_limits<Key>::digits + 1);
    const std::size_t n = *rc::gen::inRange<std::size_t>(0, 3000);
    std::vector<Key> keys(n);
    for (Key& key : keys) key = static_cast<Key>(random() >> (64 - bits));
    for (std::size_t i = 0; i < n / 2; ++i) keys[random() % n] = keys[random() % n];

    std::vector<std::uint32_t> expected(n);
    for (std::uint32_t i = 0; i < n; ++i) expected[i] = i;
    std::ranges::stable_sort(expected, {}, [&](std::uint32_t i) { return keys[i]; });
    fast::ThreadedExecutor executor(threads);
    const auto [sorted_keys, sorted_values] = sorted(executor, keys, bits);
    RC_ASSERT(sorted_values == expected);
    for (std::size_t i = 0; i < n; ++i) RC_ASSERT(sorted_keys[i] == keys[expected[i]]);
}

RC_GTEST_PROP(RadixSortByKernels, IsAStableSort, ())
{
    const auto threads = *rc::gen::inRange<std::uint32_t>(1, 5);
    expect_stable_sort<std::uint32_t>(threads);
    expect_stable_sort<std::uint64_t>(threads);
}

struct Identity {
    std::span<const std::uint32_t> of;
    std::uint32_t operator()(std::uint32_t i) const { return of[i]; }
};

struct Minimum {
    std::uint32_t operator()(std::uint32_t a, std::uint32_t b) const { return std::min(a, b); }
};

RC_GTEST_PROP(MapReduce, CombinesAllElements, (std::vector<std::uint32_t> elements))
{
    fast::ThreadedExecutor executor(*rc::gen::inRange<std::uint32_t>(1, 5));
    const auto count = static_cast<std::uint32_t>(elements.size());
    std::vector<std::uint32_t> scratch(
        fast::reduce_scratch(executor, count, Identity{elements}, Minimum{}, ~0u));
    std::vector<std::uint32_t> result(1);
    map_reduce(executor, count, Identity{elements}, Minimum{}, ~0u, std::span(scratch),
               std::span(result));
    const auto smallest = std::ranges::min_element(elements);
    RC_ASSERT(result[0] == (elements.empty() ? ~0u : *smallest));
}

RC_GTEST_PROP(Chunks, CoverEveryElementOnceAndInOrder, ())
{
    const auto count = *rc::gen::arbitrary<std::uint32_t>();
    const fast::Chunks chunks{*rc::gen::element(count, 0u, 1u, ~0u),
                              *rc::gen::inRange<std::uint32_t>(1, 50)};
    RC_ASSERT(chunks.begin(0) == 0u);
    for (std::uint32_t chunk = 0; chunk < chunks.chunks; ++chunk)
        RC_ASSERT(chunks.begin(chunk) <= chunks.end(chunk));
    RC_ASSERT(chunks.end(chunks.chunks - 1) == chunks.count);
}

} // namespace
