#pragma once

// Names and formats that the reader and the writer of EXR files share.

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace images::exr_format {

constexpr std::array<const char*, 3> rgb = {"R", "G", "B"};
constexpr const char* standard_error_layer = "se";
constexpr const char* mean_state = "state.mean";
constexpr const char* squares_state = "state.squares";
constexpr std::string_view metadata_prefix = "plumbline.";
constexpr const char* batches_attribute = "plumblineBatches";

/// The channel of colour `channel` in `layer`; the unnamed layer is the picture itself.
inline std::string channel_name(const std::string& layer, std::size_t channel)
{
    return layer.empty() ? rgb[channel] : layer + "." + rgb[channel];
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
