#pragma once

// An executor with many threads of which only one runs at a time. Before each of its atomic
// operations, a thread stops, and a function chooses the thread that goes on: at random from a seed,
// or by trying every choice. So every run can be repeated exactly.

#include "cuda/parallel/atomic.h"
#include "cuda/parallel/executor.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <semaphore>
#include <thread>
#include <vector>

namespace parallel_test {

class InterleavedExecutor {
public:
    /// Chooses the thread that goes on, out of `ready` >= 2 threads: returns a number below `ready`.
    using Choose = std::function<std::uint32_t(std::uint32_t ready)>;

    /// At most `threads` indices are in progress at the same time; a thread that has finished one
    /// takes the next.
    InterleavedExecutor(std::uint32_t threads, Choose choose) : choose_(std::move(choose))
    {
        for (std::uint32_t thread = 0; thread < threads; ++thread)
            turns_.push_back(std::make_unique<std::binary_semaphore>(0));
        for (std::uint32_t thread = 0; thread < threads; ++thread)
            threads_.emplace_back([this, thread] { serve(thread); });
    }
    ~InterleavedExecutor()
    {
        kernel_ = nullptr;
        for (const auto& turn : turns_) turn->release();
        for (std::thread& thread : threads_) thread.join();
    }
    InterleavedExecutor(const InterleavedExecutor&) = delete;
    InterleavedExecutor& operator=(const InterleavedExecutor&) = delete;

    template <fast::Kernel K>
    void operator()(std::uint32_t count, const K& kernel)
    {
        if (count == 0) return;
        kernel_ = [&](std::uint32_t index) { kernel(index); };
        count_ = count;
        ready_.clear();
        for (next_ = 0; next_ < threads_.size() && next_ < count; ++next_) ready_.push_back(next_);
        pass_baton();
        finished_.acquire();
    }
    [[nodiscard]] static std::uint32_t width() { return 3; }

private:
    void serve(std::uint32_t thread)
    {
        self_ = thread;
        current_ = this;
        fast::schedule_point = [] { current_->yield(); };
        for (;;) {
            turns_[thread]->acquire();
            if (!kernel_) return;
            for (std::uint32_t index = thread;; index = next_++) {
                kernel_(index);
                if (next_ == count_) break;
                yield();
                if (next_ == count_) break;
            }
            std::erase(ready_, thread);
            if (ready_.empty())
                finished_.release();
            else
                pass_baton();
        }
    }
    void yield()
    {
        const std::uint32_t chosen = choose();
        if (chosen == self_) return;
        turns_[chosen]->release();
        turns_[self_]->acquire();
    }
    void pass_baton() { turns_[choose()]->release(); }
    std::uint32_t choose()
    {
        const auto ready = static_cast<std::uint32_t>(ready_.size());
        return ready == 1 ? ready_[0] : ready_[choose_(ready)];
    }

    // Accessed only by the thread whose turn it is.
    Choose choose_;
    std::function<void(std::uint32_t)> kernel_;
    std::uint32_t next_ = 0; // the first index that no thread has taken
    std::uint32_t count_ = 0;
    std::vector<std::uint32_t> ready_; // threads that have not finished

    std::vector<std::unique_ptr<std::binary_semaphore>> turns_; // one per thread
    std::binary_semaphore finished_{0};
    std::vector<std::thread> threads_;
    inline static thread_local std::uint32_t self_ = 0;
    inline static thread_local InterleavedExecutor* current_ = nullptr;
};

/// All sequences of choices, one per round: `do executor(...); while (choices.next_round());`
class EveryChoice {
public:
    std::uint32_t operator()(std::uint32_t ready)
    {
        if (at_ == trail_.size()) trail_.push_back({0, ready});
        return trail_[at_++].chosen;
    }
    /// Whether there is a sequence that has not been tried yet.
    bool next_round()
    {
        at_ = 0;
        while (!trail_.empty() && trail_.back().chosen + 1 == trail_.back().options) trail_.pop_back();
        if (trail_.empty()) return false;
        ++trail_.back().chosen;
        return true;
    }

private:
    struct Choice {
        std::uint32_t chosen;
        std::uint32_t options;
    };
    std::vector<Choice> trail_;
    std::size_t at_ = 0;
};

} // namespace parallel_test
