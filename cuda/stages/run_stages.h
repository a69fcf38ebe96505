#pragma once

// How the loops over stages (trace_paths.h, trace_walks.h) run a stage, and how they access memory. The
// loops run on the host; the queues and sums may be in the memory of a GPU. So a loop reads and writes
// elements only by the object that runs its stages:
//
//   run(count, stage)    runs a stage for the indices 0 to count - 1, count > 0
//   run.clear(span)      gives all elements their default value, which is 0 for numbers
//   run.read(from, to)   waits for the work before, and copies the words `from` to the host
//   Run::in_parts        whether stages that shade are run in parts (stage_job.h: Part)
//
// The first three take effect in the order of the calls. HostStages is for the memory of the host;
// cuda/launch/launch_stages.h has the form for any memory.

#include "cuda/parallel/executor.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace fast {

/// Runs stages on an executor of the host that returns when a stage is done.
template <class E>
class HostStages {
public:
    static constexpr bool in_parts = false;

    explicit HostStages(E& executor) : executor_(executor) {}

    template <class Stage>
    void operator()(std::uint32_t count, const Stage& stage) const
    {
        executor_(count, stage);
    }
    template <class T>
    void clear(std::span<T> elements) const
    {
        std::ranges::fill(elements, T{});
    }
    void read(std::span<const std::uint32_t> from, std::span<std::uint32_t> to) const
    {
        std::ranges::copy(from, to.begin());
    }

private:
    E& executor_;
};

/// Takes spans off the front of an array.
class WordPool {
public:
    explicit WordPool(std::span<std::uint32_t> words) : rest_(words) {}

    std::span<std::uint32_t> take(std::size_t count)
    {
        const std::span<std::uint32_t> taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }
    /// Rows of `capacity` records.
    template <class Records>
    Records rows(std::uint32_t capacity)
    {
        return {take(Records::words_for(capacity)), capacity};
    }

private:
    std::span<std::uint32_t> rest_;
};

/// The counts of `queues` queues, each in a cache line of its own, since many threads increase them.
template <std::size_t queues>
class QueueCounts {
public:
    static constexpr std::size_t words = 16 * queues;

    QueueCounts() = default;
    explicit QueueCounts(WordPool& pool) : all_(pool.take(words)) {}

    /// For the stages that fill the queue.
    [[nodiscard]] std::uint32_t* of(std::size_t queue) const { return &all_[16 * queue]; }

    template <class Run>
    void clear(Run& run) const
    {
        run.clear(all_);
    }
    /// All counts, when the stages that were run are done.
    template <class Run>
    [[nodiscard]] std::array<std::uint32_t, queues> read(Run& run) const
    {
        std::array<std::uint32_t, words> copies;
        run.read(all_, copies);
        std::array<std::uint32_t, queues> counts;
        for (std::size_t i = 0; i < queues; ++i) counts[i] = copies[16 * i];
        return counts;
    }

private:
    std::span<std::uint32_t> all_;
};

} // namespace fast
