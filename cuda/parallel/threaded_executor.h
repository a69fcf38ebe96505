#pragma once

// Kernels on the threads of the host.

#include "cuda/parallel/executor.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace fast {

/// Runs every kernel on the same `threads` threads (the calling one is the first of them), which sleep
/// in between. Blocks of at most `most_per_block` neighbouring indices are dealt to them in turn: with
/// blocks of one, neighbours always meet on different threads. To be called from one thread at a time.
class ThreadedExecutor {
public:
    explicit ThreadedExecutor(std::uint32_t threads, std::uint32_t most_per_block = 4096);
    ~ThreadedExecutor();
    ThreadedExecutor(const ThreadedExecutor&) = delete;
    ThreadedExecutor& operator=(const ThreadedExecutor&) = delete;

    /// Returns when all indices are done; everything they wrote is visible to the caller.
    template <Kernel K>
    void operator()(std::uint32_t count, const K& kernel)
    {
        const std::uint64_t share = (std::uint64_t{count} + width() - 1) / width();
        const std::uint64_t block = std::clamp<std::uint64_t>(share, 1, most_per_block_);
        const auto work = [&](std::uint32_t thread) {
            for (std::uint64_t begin = thread * block; begin < count; begin += width() * block) {
                const std::uint64_t end = std::min<std::uint64_t>(begin + block, count);
                for (std::uint64_t index = begin; index < end; ++index)
                    kernel(static_cast<std::uint32_t>(index));
            }
        };
        run(std::ref(work));
    }
    /// Nothing is ever queued here.
    void wait() const {}
    [[nodiscard]] std::uint32_t width() const { return static_cast<std::uint32_t>(workers_.size()) + 1; }

private:
    using Work = std::function<void(std::uint32_t thread)>;

    /// Calls work(0) here and work(1), work(2), ... on the workers; returns when all have returned.
    void run(const Work& work);
    void serve(std::uint32_t thread);

    std::uint32_t most_per_block_;
    std::vector<std::thread> workers_;
    const Work* work_ = nullptr; // of the present round; none: the workers shall end
    std::atomic<std::uint32_t> round_ = 0;
    std::atomic<std::uint32_t> busy_ = 0; // workers that have not finished the present round
};

} // namespace fast
