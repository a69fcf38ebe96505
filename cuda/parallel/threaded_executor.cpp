#include "cuda/parallel/threaded_executor.h"

namespace fast {

ThreadedExecutor::ThreadedExecutor(std::uint32_t threads, std::uint32_t most_per_block)
    : most_per_block_(std::max(most_per_block, 1u))
{
    for (std::uint32_t thread = 1; thread < threads; ++thread)
        workers_.emplace_back([this, thread] { serve(thread); });
}

ThreadedExecutor::~ThreadedExecutor()
{
    work_ = nullptr;
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
    for (std::thread& worker : workers_) worker.join();
}

void ThreadedExecutor::run(const Work& work)
{
    work_ = &work;
    busy_.store(width() - 1, std::memory_order_relaxed);
    // Publishes `work_`, `busy_` and everything that the caller has written so far.
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
    work(0);
    // This load reads the value of the last worker, which ends a release sequence over all workers. So
    // everything that they wrote is visible here.
    while (const std::uint32_t busy = busy_.load(std::memory_order_acquire)) busy_.wait(busy);
}

void ThreadedExecutor::serve(std::uint32_t thread)
{
    for (std::uint32_t round = 0;;) {
        round_.wait(round, std::memory_order_acquire);
        round = round_.load(std::memory_order_acquire);
        if (work_ == nullptr) return;
        (*work_)(thread);
        if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1) busy_.notify_one();
    }
}

} // namespace fast
