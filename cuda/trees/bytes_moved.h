#pragma once

// A lower bound of the bytes that each stage of a build moves, to compare its time with the bandwidth of
// the memory.

#include "cuda/trees/lbvh.h"

namespace fast {

/// Digits of a sort, and whether all their counts come from one pass over the keys before (as CUB does
/// it) or from one pass each (as radix_sort.h does it).
struct SortPasses {
    int digits;
    int counts;
};

inline SortPasses passes_on_host(int code_bits)
{
    const int digits = (code_bits + most_digit_bits - 1) / most_digit_bits;
    return {digits, digits};
}

/// CUB sorts by digits of 8 bits, and counts them all at once.
inline SortPasses passes_on_device(int code_bits)
{
    return {(code_bits + 7) / 8, 1};
}

/// Bytes that `stage` reads and writes over n primitives if every value crosses to the processor once,
/// and once back: the least there is. What is read again, by neighbours or in search, is hoped to be in
/// a cache.
inline double bytes_moved(Stage stage, std::uint32_t n, int code_bits, const SortPasses& passes)
{
    const double code = code_bits == 30 ? 4 : 8;
    constexpr double number = 4; // of a primitive, or a link
    constexpr double box = 24;
    switch (stage) {
    case Stage::bounds:
        return n * box;
    case Stage::codes:
        return n * (box + code + number);
    case Stage::sort:
        return n * (passes.counts * code + passes.digits * 2 * (code + number));
    case Stage::tree: // two children, a link, the arrivals, and a leaf's link
        return n * (code + 5 * number);
    case Stage::refit:
        // Of a leaf its number, its link and its box; of a node both boxes written, one read back, its
        // link read, its arrivals changed three times.
        return n * ((2 * number + box) + (3 * box + number + 3 * 2 * number));
    }
    return 0;
}

} // namespace fast
