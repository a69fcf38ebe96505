#pragma once

// Sorts keys digit by digit, the least significant first. Each pass is stable, so keys that agree in all
// digits keep their order: among equal codes the lower index comes first.

#include <array>
#include <cstdint>
#include <vector>

namespace ref {

/// A Morton code and the primitive it belongs to.
struct CodedPrimitive {
    std::uint64_t code;
    std::uint32_t primitive;
};

/// Sorts by code. Only the lowest `code_bits` bits may be set.
inline void radix_sort(std::vector<CodedPrimitive>& items, int code_bits)
{
    constexpr int digit_bits = 11; // 2^11 counters and write positions stay in the first-level cache
    constexpr std::size_t digits = std::size_t{1} << digit_bits;
    std::vector<CodedPrimitive> sorted(items.size());
    for (int shift = 0; shift < code_bits; shift += digit_bits) {
        const auto digit = [&](const CodedPrimitive& item) { return item.code >> shift & (digits - 1); };
        std::array<std::size_t, digits> begin{};
        for (const CodedPrimitive& item : items) ++begin[digit(item)];
        std::size_t sum = 0;
        for (std::size_t& count : begin) { // from counts to where each digit's items begin
            const std::size_t first = sum;
            sum += count;
            count = first;
        }
        for (const CodedPrimitive& item : items) sorted[begin[digit(item)]++] = item;
        items.swap(sorted);
    }
}

} // namespace ref
