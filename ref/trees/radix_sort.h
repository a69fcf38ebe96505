#pragma once

// Sorts keys digit by digit, the least significant digit first. Each pass is stable, so keys that
// agree in all digits keep their order: among equal codes the lower index comes first.

#include <array>
#include <cstdint>
#include <vector>

namespace ref {

/// Sorts `codes` and moves `primitives` in the same way, so that the pairs stay together. Only the
/// lowest `code_bits` bits of a code may be set.
inline void radix_sort(std::vector<std::uint64_t>& codes, std::vector<std::uint32_t>& primitives,
                       int code_bits)
{
    constexpr int digit_bits = 11; // 2^11 counters and write positions fit into the first-level cache
    constexpr std::size_t digits = std::size_t{1} << digit_bits;
    std::vector<std::uint64_t> sorted_codes(codes.size());
    std::vector<std::uint32_t> sorted_primitives(codes.size());
    for (int shift = 0; shift < code_bits; shift += digit_bits) {
        const auto digit = [&](std::uint64_t code) { return code >> shift & (digits - 1); };
        std::array<std::size_t, digits> begin{};
        for (const std::uint64_t code : codes) ++begin[digit(code)];
        std::size_t sum = 0;
        for (std::size_t& count : begin) { // replaces counts by the place where each digit's codes begin
            const std::size_t first = sum;
            sum += count;
            count = first;
        }
        for (std::size_t i = 0; i < codes.size(); ++i) {
            const std::size_t place = begin[digit(codes[i])]++;
            sorted_codes[place] = codes[i];
            sorted_primitives[place] = primitives[i];
        }
        codes.swap(sorted_codes);
        primitives.swap(sorted_primitives);
    }
}

} // namespace ref
