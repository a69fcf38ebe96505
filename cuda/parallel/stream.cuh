#pragma once

// A CUDA stream that is destroyed with its owner.

#include "cuda/parallel/check.cuh"

#include <cuda_runtime.h>

namespace fast {

class Stream {
public:
    Stream() { check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking)); }
    ~Stream() { cudaStreamDestroy(stream_); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;
    [[nodiscard]] cudaStream_t get() const { return stream_; }

private:
    cudaStream_t stream_{};
};

} // namespace fast
