#pragma once

#include "cuda/launch/device.h"
#include "cuda/parallel/device_memory.cuh"
#include "cuda/parallel/executor.cuh"
#include "cuda/parallel/primitives.cuh"
#include "cuda/parallel/stream.cuh"

#include <stdexcept>

namespace fast {

/// Throws std::runtime_error if there is no GPU.
inline void require_device()
{
    if (const Device device = find_device(); !device.usable)
        throw std::runtime_error(device.description);
}

/// run(memory, executor) on the first GPU, on a stream of its own. Throws as require_device.
template <class Run>
auto on_device(const Run& run)
{
    require_device();
    const Stream stream;
    DeviceMemory memory(stream.get());
    CudaExecutor executor(stream.get());
    return run(memory, executor);
}

} // namespace fast
