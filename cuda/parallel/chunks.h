#pragma once

// The division of many elements into a few contiguous pieces.

#include "cuda/parallel/host_device.h"

#include <cstdint>

namespace fast {

/// Elements 0 to count - 1 in `chunks` (at least 1) pieces of equal size, except for the last ones.
struct Chunks {
    std::uint32_t count;
    std::uint32_t chunks;

    [[nodiscard]] HD std::uint32_t begin(std::uint32_t chunk) const
    {
        return static_cast<std::uint32_t>(std::uint64_t{count} * chunk / chunks);
    }
    [[nodiscard]] HD std::uint32_t end(std::uint32_t chunk) const { return begin(chunk + 1); }
};

} // namespace fast
