#pragma once

// Kernels on a GPU.

#include "cuda/parallel/check.cuh"
#include "cuda/parallel/executor.h"

#include <cuda_runtime.h>

namespace fast {

constexpr std::uint32_t block_size = 256;

/// The blocks that must fit on a multiprocessor, which has 65,536 registers. Two: a thread has at most
/// 128 registers. A kernel may ask for more blocks by a member of this name: four leave 64 registers.
template <class K>
inline constexpr int least_blocks = 2;
template <class K>
requires requires
{
    K::least_blocks;
}
inline constexpr int least_blocks<K> = K::least_blocks;

/// The kernel stays in the memory of parameters, also where its address is passed to a function.
template <Kernel K>
__global__ void __launch_bounds__(block_size, least_blocks<K>)
    run_kernel(const __grid_constant__ K kernel, std::uint32_t count)
{
    const std::uint32_t index = blockIdx.x * blockDim.x + threadIdx.x;
    if (index < count) kernel(index);
}

/// One device thread per index, on a stream: launches are queued and run in order.
class CudaExecutor {
public:
    explicit CudaExecutor(cudaStream_t stream) : stream_(stream) {}

    template <Kernel K>
    void operator()(std::uint32_t count, const K& kernel) const
    {
        if (count == 0) return; // a grid without blocks is an error in CUDA
        run_kernel<<<(count - 1) / block_size + 1, block_size, 0, stream_>>>(kernel, count);
        check(cudaGetLastError());
    }
    /// Returns when all queued work is done.
    void wait() const { check(cudaStreamSynchronize(stream_)); }
    [[nodiscard]] cudaStream_t stream() const { return stream_; }

private:
    cudaStream_t stream_;
};

} // namespace fast
