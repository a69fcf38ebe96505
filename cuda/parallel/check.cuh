#pragma once

// Errors of the CUDA runtime as exceptions.

#include <cuda_runtime.h>

#include <stdexcept>
#include <string>

namespace fast {

/// Throws std::runtime_error unless `status` is success.
inline void check(cudaError_t status)
{
    if (status == cudaSuccess) return;
    cudaGetLastError(); // an error that can be recovered from is not reported again by the next call
    throw std::runtime_error(std::string("CUDA: ") + cudaGetErrorString(status));
}

} // namespace fast
