#pragma once

// Reduces many values to one. On a device CUB does it (primitives.cuh); this file is for the executors
// of the host.

#include "cuda/parallel/chunks.h"
#include "cuda/parallel/executor.h"

#include <cstddef>
#include <span>

namespace fast {

/// Kernel over chunks: combines map(i) for the elements i of a chunk.
template <class T, class Map, class Combine>
struct ReduceChunk {
    Chunks chunks;
    Map map;
    Combine combine;
    T neutral;
    std::span<T> partial; // one per chunk

    HD void operator()(std::uint32_t chunk) const
    {
        T sum = neutral;
        for (std::uint32_t i = chunks.begin(chunk); i < chunks.end(chunk); ++i)
            sum = combine(sum, map(i));
        partial[chunk] = sum;
    }
};

/// Kernel of one index: combines the results of all chunks.
template <class T, class Combine>
struct ReducePartial {
    std::span<const T> partial;
    Combine combine;
    T neutral;
    std::span<T> result;

    HD void operator()(std::uint32_t /*index*/) const
    {
        T sum = neutral;
        for (const T& part : partial) sum = combine(sum, part);
        result[0] = sum;
    }
};

/// The number of elements of scratch memory that `map_reduce` needs with the same arguments.
template <class T, HostExecutor E, class Map, class Combine>
std::size_t reduce_scratch(const E& executor, std::uint32_t /*count*/, const Map& /*map*/,
                           const Combine& /*combine*/, const T& /*neutral*/)
{
    return executor.width();
}

/// result[0] = the combination of map(0), ..., map(count - 1) and `neutral`. `combine` must be
/// associative and commutative without rounding, like minimum and maximum, because the grouping of the
/// elements is not specified.
template <class T, HostExecutor E, class Map, class Combine>
void map_reduce(E& executor, std::uint32_t count, const Map& map, const Combine& combine,
                const T& neutral, std::span<T> scratch, std::span<T> result)
{
    const Chunks chunks{count, executor.width()};
    const std::span<T> partial = scratch.first(chunks.chunks);
    executor(chunks.chunks, ReduceChunk<T, Map, Combine>{chunks, map, combine, neutral, partial});
    executor(1, ReducePartial<T, Combine>{partial, combine, neutral, result});
}

} // namespace fast
