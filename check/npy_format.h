#pragma once

// What the reader and the writer of `.npy` files share.

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace check::npy_format {

constexpr std::string_view magic = "\x93NUMPY";

/// The product of the extents; none if it exceeds 2^48.
inline std::optional<std::size_t> element_count(std::span<const std::size_t> shape)
{
    std::size_t count = 1;
    for (const std::size_t extent : shape) {
        if (extent == 0) return 0;
        if (extent > (std::size_t{1} << 48) / count) return {};
        count *= extent;
    }
    return count;
}

} // namespace check::npy_format
