#pragma once

// The GPU, if any, that this program can use.

#include <cstddef>
#include <string>

namespace fast {

struct Device {
    bool usable;                 // there is a device, and it ran one of our kernels
    std::string description;     // one line for a person: the device, or why there is none
    double bytes_per_second = 0; // bandwidth of its memory; 0: unknown
    std::size_t cache_bytes = 0; // size of its last-level cache; 0: unknown
};

/// Queries the first CUDA device and runs an empty kernel on it. Throws nothing: a machine without a
/// GPU is not an error.
Device find_device();

/// find_device().description: "NVIDIA H100 80GB HBM3, sm_90, driver for CUDA 13.0, 79 GiB", "built
/// without nvcc", or "built with nvcc 13.0, no CUDA device found: REASON".
std::string describe_device();

} // namespace fast
