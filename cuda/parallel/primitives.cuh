#pragma once

// The functions of reduce.h and radix_sort.h on a GPU, by CUB, which is optimised for the hardware.
// Slow to compile, so only one .cu file includes it.

#include "cuda/parallel/executor.cuh"
#include "cuda/parallel/radix_sort.h"

#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_reduce.cuh>
#include <thrust/iterator/counting_iterator.h>

#include <span>

namespace fast {

template <class T, class Map, class Combine>
std::size_t reduce_scratch(const CudaExecutor& executor, std::uint32_t count, const Map& map,
                           const Combine& combine, const T& neutral)
{
    std::size_t bytes = 0;
    check(cub::DeviceReduce::TransformReduce(nullptr, bytes, thrust::counting_iterator<std::uint32_t>(0),
                                             static_cast<T*>(nullptr), count, combine, map, neutral,
                                             executor.stream()));
    return (bytes + sizeof(T) - 1) / sizeof(T);
}

template <class T, class Map, class Combine>
void map_reduce(CudaExecutor& executor, std::uint32_t count, const Map& map, const Combine& combine,
                const T& neutral, std::span<T> scratch, std::span<T> result)
{
    std::size_t bytes = scratch.size_bytes();
    check(cub::DeviceReduce::TransformReduce(scratch.data(), bytes,
                                             thrust::counting_iterator<std::uint32_t>(0), result.data(),
                                             count, combine, map, neutral, executor.stream()));
}

template <class Key, class Value>
std::size_t sort_scratch(const CudaExecutor& executor, std::uint32_t count, int bits)
{
    std::size_t bytes = 0;
    cub::DoubleBuffer<Key> keys;
    cub::DoubleBuffer<Value> values;
    check(cub::DeviceRadixSort::SortPairs(nullptr, bytes, keys, values, count, 0, bits,
                                          executor.stream()));
    return (bytes + sizeof(std::uint32_t) - 1) / sizeof(std::uint32_t);
}

template <class Key, class Value>
void radix_sort(CudaExecutor& executor, Alternating<Key>& keys, Alternating<Value>& values, int bits,
                std::span<std::uint32_t> scratch)
{
    const auto count = static_cast<std::uint32_t>(keys.current.size());
    std::size_t bytes = scratch.size_bytes();
    cub::DoubleBuffer<Key> k(keys.current.data(), keys.other.data());
    cub::DoubleBuffer<Value> v(values.current.data(), values.other.data());
    check(
        cub::DeviceRadixSort::SortPairs(scratch.data(), bytes, k, v, count, 0, bits, executor.stream()));
    if (k.Current() != keys.current.data()) keys.swap();
    if (v.Current() != values.current.data()) values.swap();
}

} // namespace fast
