#pragma once

// Runs kernels on threads of the host.

#include "cuda/parallel/executor.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

namespace fast {

/// Runs every kernel on the same `threads` threads, which sleep in between; the calling thread is the
/// first of them. Every thread has a first block of at most `most_per_block` neighbouring indices, and
/// then takes the next block as soon as it is free: so a thread that has to wait for a processor does
/// not delay the others. Blocks of one are given to the threads in turn instead: neighbours always run
/// on different threads. Must be called from one thread at a time.
class ThreadedExecutor {
public:
    explicit ThreadedExecutor(std::uint32_t threads, std::uint32_t most_per_block = 4096);
    ~ThreadedExecutor();
    ThreadedExecutor(const ThreadedExecutor&) = delete;
    ThreadedExecutor& operator=(const ThreadedExecutor&) = delete;

    /// Returns when all indices are done; everything that they wrote is visible to the caller.
    template <Kernel K>
    void operator()(std::uint32_t count, const K& kernel)
    {
        const std::uint64_t share = (std::uint64_t{count} + width() - 1) / width();
        const std::uint64_t block = std::clamp<std::uint64_t>(share, 1, most_per_block_);
        const bool in_turn = most_per_block_ == 1;
        std::atomic<std::uint64_t> next = width(); // block
        const auto work = [&](std::uint32_t thread) {
            for (std::uint64_t at = thread; at * block < count;
                 at = in_turn ? at + width() : next.fetch_add(1, std::memory_order_relaxed)) {
                const std::uint64_t end = std::min<std::uint64_t>((at + 1) * block, count);
                for (std::uint64_t index = at * block; index < end; ++index)
                    kernel(static_cast<std::uint32_t>(index));
            }
        };
        run(std::ref(work));
    }
    /// Returns at once: every launch is complete when it returns.
    void wait() const {}
    [[nodiscard]] std::uint32_t width() const { return static_cast<std::uint32_t>(workers_.size()) + 1; }

private:
    using Work = std::function<void(std::uint32_t thread)>;

    /// Calls work(0) here and work(1), work(2), ... on the workers; returns when all have returned.
    void run(const Work& work);
    void serve(std::uint32_t thread);

    std::uint32_t most_per_block_;
    std::vector<std::thread> workers_;
    const Work* work_ = nullptr; // of the current round; null: the workers shall end
    std::atomic<std::uint32_t> round_ = 0;
    std::atomic<std::uint32_t> busy_ = 0; // workers that have not finished the current round
};

} // namespace fast
