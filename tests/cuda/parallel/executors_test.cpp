// The guarantees of every executor, and those of the interleaved executor itself.

#include "cuda/parallel/threaded_executor.h"
#include "tests/cuda/parallel/interleaved_executor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>
#include <set>
#include <span>

namespace {

using parallel_test::EveryChoice;
using parallel_test::InterleavedExecutor;

/// Counts its calls per index without an atomic operation: one call per index must be enough.
struct CountCalls {
    std::span<std::uint32_t> calls;
    void operator()(std::uint32_t index) const { ++calls[index]; }
};

template <fast::Executor E>
void expect_one_call_per_index(E& executor)
{
    for (const std::uint32_t count : {0u, 1u, 2u, 3u, 7u, 8u, 9u, 100u, 1000u}) {
        std::vector<std::uint32_t> calls(count, 0);
        executor(count, CountCalls{calls});
        executor(count, CountCalls{calls});
        EXPECT_EQ(calls, std::vector<std::uint32_t>(count, 2)) << count;
    }
}

std::uint32_t the_last(std::uint32_t ready)
{
    return ready - 1;
}

TEST(Executors, CallTheKernelOnceForEveryIndex)
{
    fast::SerialExecutor serial;
    expect_one_call_per_index(serial);
    for (const std::uint32_t threads : {1u, 2u, 3u, 8u})
        for (const std::uint32_t block : {1u, 5u, 4096u}) {
            fast::ThreadedExecutor threaded(threads, block);
            EXPECT_EQ(threaded.width(), threads);
            expect_one_call_per_index(threaded);
        }
    InterleavedExecutor interleaved(4, the_last);
    expect_one_call_per_index(interleaved);
}

/// Each index reads a value that another index wrote in the launch before.
struct Rotate {
    std::span<const std::uint32_t> from;
    std::span<std::uint32_t> to;
    void operator()(std::uint32_t index) const { to[index] = from[(index + 1) % from.size()]; }
};

TEST(Executors, ShowEachLaunchWhatTheOneBeforeWrote) // if only by chance, ThreadSanitizer reports it
{
    fast::ThreadedExecutor executor(4, 1);
    std::vector<std::uint32_t> a(64);
    std::iota(a.begin(), a.end(), 0);
    const std::vector<std::uint32_t> start = a;
    std::vector<std::uint32_t> b(64);
    for (int i = 0; i < 320; ++i) {
        executor(64, Rotate{a, b});
        a.swap(b);
    }
    EXPECT_EQ(a, start); // 320 = 5 * 64
}

struct NoteThread {
    std::span<std::thread::id> thread;
    void operator()(std::uint32_t index) const { thread[index] = std::this_thread::get_id(); }
};

TEST(ThreadedExecutor, GivesNeighboursToDifferentThreadsWhenBlocksAreOfOne)
{
    fast::ThreadedExecutor executor(3, 1);
    std::vector<std::thread::id> thread(30);
    executor(30, NoteThread{thread});
    for (std::size_t i = 0; i + 1 < 30; ++i) EXPECT_NE(thread[i], thread[i + 1]);
    EXPECT_EQ(std::set(thread.begin(), thread.end()).size(), 3u);
    EXPECT_EQ(thread[0], std::this_thread::get_id());
}

TEST(ThreadedExecutor, SharesOutLargeLaunchesAndSmallOnes)
{
    fast::ThreadedExecutor executor(4, 4096);
    for (const std::uint32_t count : {4u, 1000u, 100000u}) {
        std::vector<std::thread::id> thread(count);
        executor(count, NoteThread{thread});
        EXPECT_EQ(std::set(thread.begin(), thread.end()).size(), 4u) << count;
    }
}

/// The first index waits until the indices of all blocks of two but its own have ended, at most ten
/// seconds.
struct WaitForOthers {
    std::uint32_t count;
    std::atomic<std::uint32_t>* ended;
    std::atomic<bool>* all_ended;
    void operator()(std::uint32_t index) const
    {
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
        while (index == 0 && !*all_ended && std::chrono::steady_clock::now() < deadline)
            *all_ended = *ended + 2 == count;
        ++*ended;
    }
};

TEST(ThreadedExecutor, GivesBlocksToTheThreadThatIsFree)
{
    fast::ThreadedExecutor executor(2, 2);
    std::atomic<std::uint32_t> ended = 0;
    std::atomic<bool> all_ended = false;
    executor(100, WaitForOthers{100, &ended, &all_ended});
    EXPECT_TRUE(all_ended);
    EXPECT_EQ(ended, 100u);
}

/// Adds one to a counter, in `steps` atomic steps of which only the last one matters.
struct Count {
    std::span<std::uint32_t> trace; // index of every step, in the order of execution
    std::uint32_t steps;
    std::uint32_t& taken;
    void operator()(std::uint32_t index) const
    {
        for (std::uint32_t step = 0; step < steps; ++step) {
            fast::schedule_point();
            trace[taken++] = index;
        }
    }
};

TEST(InterleavedExecutor, ReachesEveryInterleavingOnce)
{
    // Two threads, each with a first piece and two steps before which it can be interrupted. That is
    // three pieces each, which gives 6! / (3! 3!) = 20 orders. The first piece takes no step, so only
    // the orders of the others can be distinguished: 4! / (2! 2!) = 6.
    EveryChoice choices;
    InterleavedExecutor executor(2, std::ref(choices));
    std::set<std::vector<std::uint32_t>> traces;
    int rounds = 0;
    do {
        std::vector<std::uint32_t> trace(4);
        std::uint32_t taken = 0;
        executor(2, Count{trace, 2, taken});
        traces.insert(trace);
        ++rounds;
    } while (choices.next_round());
    EXPECT_EQ(rounds, 20);
    EXPECT_EQ(traces.size(), 6u);
}

TEST(InterleavedExecutor, RepeatsARunFromItsChoices)
{
    const auto run = [](std::uint32_t seed) {
        InterleavedExecutor executor(5, [seed](std::uint32_t ready) mutable {
            seed = seed * 1664525 + 1013904223;
            return (seed >> 16) % ready;
        });
        std::vector<std::uint32_t> trace(60);
        std::uint32_t taken = 0;
        executor(20, Count{trace, 3, taken});
        return trace;
    };
    EXPECT_EQ(run(1), run(1));
    EXPECT_NE(run(1), run(2));
    EXPECT_FALSE(std::ranges::is_sorted(run(1)));
}

} // namespace
