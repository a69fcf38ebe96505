#pragma once

// Which GPU, if any, this program can use.

#include <cstddef>
#include <string>

namespace fast {

struct Device {
    bool usable;                 // there is one, and it ran a kernel of ours
    std::string description;     // one line for a person: the device, or why there is none
    double bytes_per_second = 0; // what its memory can move at most; 0: not known
    std::size_t cache_bytes = 0; // of its last cache; 0: not known
};

/// Looks at the first CUDA device and runs an empty kernel on it. Raises no errors: a machine without a
/// GPU is an ordinary machine.
Device find_device();

/// find_device().description: "NVIDIA H100 80GB HBM3, sm_90, driver for CUDA 13.0, 79 GiB", "built
/// without nvcc", or "built with nvcc 13.0, no CUDA device found: REASON".
std::string describe_device();

} // namespace fast
