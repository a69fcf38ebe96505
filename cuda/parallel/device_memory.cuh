#pragma once

// The memory of a GPU.

#include "cuda/parallel/check.cuh"
#include "cuda/parallel/memory.h"

namespace fast {

/// Blocks are allocated and released in the order of a stream: work that is queued before a release
/// may still use the block.
class DeviceMemory : public Memory {
public:
    explicit DeviceMemory(cudaStream_t stream) : stream_(stream) {}

    void release(void* block) noexcept override
    {
        cudaFreeAsync(block, stream_); // fails only if the device is lost
    }
    void write(void* to, const void* from, std::size_t bytes) override
    {
        check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, stream_));
        check(cudaStreamSynchronize(stream_));
    }
    void read(void* to, const void* from, std::size_t bytes) override
    {
        check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, stream_));
        check(cudaStreamSynchronize(stream_));
    }

private:
    void* try_allocate(std::size_t bytes) override
    {
        void* block = nullptr;
        const cudaError_t status = cudaMallocAsync(&block, bytes, stream_);
        if (status != cudaErrorMemoryAllocation) {
            check(status);
            return block;
        }
        cudaGetLastError(); // clears the error, so that the next call does not report it again
        return nullptr;
    }
    [[nodiscard]] std::size_t free_bytes() const override
    {
        std::size_t free = 0;
        std::size_t total = 0;
        check(cudaMemGetInfo(&free, &total));
        return free;
    }
    [[nodiscard]] std::string name() const override { return "device memory"; }

    cudaStream_t stream_;
};

} // namespace fast
