#pragma once

// Names and formats that the reader and the writer of EXR files share.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace images::exr_format {

constexpr std::array<const char*, 3> rgb = {"R", "G", "B"};
constexpr const char* standard_error_layer = "se";
constexpr std::string_view metadata_prefix = "plumbline.";
constexpr const char* batches_attribute = "plumblineBatches";
constexpr const char* range_attribute = "plumblineBatchRange";
constexpr const char* checksum_attribute = "plumblineChecksum";

/// The channel of colour `channel` in `layer`; the unnamed layer is the picture itself.
inline std::string channel_name(const std::string& layer, std::size_t channel)
{
    return layer.empty() ? rgb[channel] : layer + "." + rgb[channel];
}

/// What block number `block` of a film's state holds: "mean", "squares", or the sum of a strategy.
inline std::string state_name(std::size_t block, const std::string& what)
{
    const std::string digits = std::to_string(block);
    return "state." + std::string(3 - std::min<std::size_t>(3, digits.size()), '0') + digits + "." +
           what;
}

/// A double as two words, high and low.
struct Words {
    std::uint32_t hi, lo;
};

inline Words split(double value)
{
    const auto bits = std::bit_cast<std::uint64_t>(value);
    return {static_cast<std::uint32_t>(bits >> 32), static_cast<std::uint32_t>(bits)};
}

inline double join(Words words)
{
    return std::bit_cast<double>(static_cast<std::uint64_t>(words.hi) << 32 | words.lo);
}

} // namespace images::exr_format
