#pragma once

// Ranges of batches, and the blocks of which they consist.

#include "images/whole_number.h"

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace images {

/// Batches first <= number < end.
struct BatchRange {
    std::uint64_t first = 0;
    std::uint64_t end = 0;
    [[nodiscard]] std::uint64_t size() const { return end - first; }
    friend bool operator==(const BatchRange&, const BatchRange&) = default;
};

/// "4..8"
inline std::string describe(const BatchRange& range)
{
    return std::to_string(range.first) + ".." + std::to_string(range.end);
}

/// The number of batches in the largest block that begins at `first` and does not pass `end` > first.
inline std::uint64_t largest_block(std::uint64_t first, std::uint64_t end)
{
    const std::uint64_t fits = std::bit_floor(end - first);
    const std::uint64_t aligned = first & (~first + 1); // the largest power of two that divides it
    return first == 0 || fits < aligned ? fits : aligned;
}

/// The ranges of the largest blocks of `range`, ascending.
inline std::vector<BatchRange> largest_blocks(const BatchRange& range)
{
    std::vector<BatchRange> blocks;
    for (std::uint64_t at = range.first; at < range.end; at = blocks.back().end)
        blocks.push_back({at, at + largest_block(at, range.end)});
    return blocks;
}

/// "4..8" as a range; none for another text, and for an end before the beginning.
inline std::optional<BatchRange> parse_range(std::string_view text)
{
    const std::size_t dots = text.find("..");
    if (dots == std::string_view::npos) return std::nullopt;
    const auto first = whole_number(text.substr(0, dots));
    const auto end = whole_number(text.substr(dots + 2));
    if (!first || !end || *end < *first) return std::nullopt;
    return BatchRange{*first, *end};
}

} // namespace images
