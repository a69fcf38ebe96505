#pragma once

// The loop over the stages of path tracing.

#include "cuda/stages/path_stages.h"

#include <utility>

namespace fast {

/// The memory for the unfinished paths of a block.
class PathMemory {
public:
    /// For up to `capacity` paths. `words`: words_for(capacity).
    PathMemory(std::span<std::uint32_t> words, std::uint32_t capacity)
    {
        const auto take = [&](std::size_t count) {
            const std::span<std::uint32_t> taken = words.first(count);
            words = words.subspan(count);
            return taken;
        };
        counts_ = take(2 * counts_apart);
        for (Rows<PathStateOf>& rows : paths_)
            rows = {take(Rows<PathStateOf>::words_for(capacity)), capacity};
        hits_ = {take(Rows<HitOf>::words_for(capacity)), capacity};
        waiting_ = {take(Rows<WaitingOf>::words_for(capacity)), capacity};
    }
    static constexpr std::size_t words_for(std::uint32_t capacity)
    {
        return 2 * counts_apart + 2 * Rows<PathStateOf>::words_for(capacity) +
               Rows<HitOf>::words_for(capacity) + Rows<WaitingOf>::words_for(capacity);
    }

    /// Traces the samples first_slot ... first_slot + count - 1 of a launch. `run` executes each stage
    /// and returns when it is done.
    template <Needs needs, class Run>
    void trace(Run&& run, const StageJob<needs>& job, std::uint32_t first_slot, std::uint32_t count)
    {
        for (std::uint32_t i = 0; i < count; ++i) job.film.own[first_slot + i] = Rgb(0.0f);
        run(count, Generate<needs>{job, first_slot, paths_[0]});
        std::uint32_t& going_on = counts_[0];
        std::uint32_t& candidates = counts_[counts_apart];
        for (int n = 1; n <= job.options.max_edges && count > 0; ++n) {
            going_on = 0;
            candidates = 0;
            run(count, Extend<needs, PathStateOf>{job, paths_[0], hits_});
            run(count,
                Shade<needs>{job, n, paths_[0], hits_, {paths_[1], &going_on}, {waiting_, &candidates}});
            run(candidates, TestShadow<needs>{job, 1, n + 1, waiting_});
            std::swap(paths_[0], paths_[1]);
            count = going_on;
        }
    }

private:
    static constexpr std::size_t counts_apart = 16; // a cache line

    std::span<std::uint32_t> counts_;
    Rows<PathStateOf> paths_[2]; // of vertex n, and those that go on
    Rows<HitOf> hits_;
    Rows<WaitingOf> waiting_;
};

} // namespace fast
