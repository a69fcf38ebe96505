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
    cudaGetLastError(); // clears the error, so that the next call does not report it again
    throw std::runtime_error(std::string("CUDA: ") + cudaGetErrorString(status));
}

} // namespace fast
