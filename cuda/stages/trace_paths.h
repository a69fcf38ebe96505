#pragma once

// The loop over the stages of path tracing.

#include "cuda/stages/path_stages.h"
#include "cuda/stages/run_stages.h"

#include <utility>

namespace fast {

/// The memory for the unfinished paths of a block.
class PathMemory {
public:
    /// For up to `capacity` paths. `words`: words_for(capacity), in the memory of the stages.
    PathMemory(std::span<std::uint32_t> words, std::uint32_t capacity)
    {
        WordPool pool(words);
        counts_ = QueueCounts<queues>(pool);
        for (Rows<PathStateOf>& rows : paths_) rows = pool.rows<Rows<PathStateOf>>(capacity);
        hits_ = pool.rows<Rows<HitOf>>(capacity);
        waiting_ = pool.rows<Rows<WaitingOf>>(capacity);
    }
    static constexpr std::size_t words_for(std::uint32_t capacity)
    {
        return QueueCounts<queues>::words + 2 * Rows<PathStateOf>::words_for(capacity) +
               Rows<HitOf>::words_for(capacity) + Rows<WaitingOf>::words_for(capacity);
    }

    /// Traces the samples first_slot ... first_slot + count - 1 of a launch. `run`: run_stages.h. Reads
    /// counts once for each vertex of the longest path. A stage that has nothing to do is not run.
    template <Needs needs, class Run>
    void trace(Run& run, const StageJob<needs>& job, std::uint32_t first_slot, std::uint32_t count)
    {
        run.clear(job.film.own.subspan(first_slot, count));
        run(count, Generate<needs>{job, first_slot, paths_[0]});
        for (int n = 1; count > 0; ++n) {
            run(count, Extend<needs, PathStateOf>{job, paths_[0], hits_});
            counts_.clear(run);
            if constexpr (Run::in_parts && needs.coincident) {
                if (n < job.options.max_edges && !job.scene.cumulative.empty())
                    shade<Part::joins>(run, job, n, count);
                shade<Part::bounce>(run, job, n, count);
            } else {
                shade<Part::all>(run, job, n, count);
            }
            if (n == job.options.max_edges) return; // no bounce and no candidates
            const auto filled = counts_.read(run);
            if (filled[candidates] > 0)
                run(filled[candidates], TestShadow<needs>{job, 1, n + 1, waiting_});
            std::swap(paths_[0], paths_[1]);
            count = filled[going_on];
        }
    }

private:
    template <Part part, Needs needs, class Run>
    void shade(Run& run, const StageJob<needs>& job, int n, std::uint32_t count)
    {
        run(count, Shade<needs, part>{job,
                                      n,
                                      paths_[0],
                                      hits_,
                                      {paths_[1], counts_.of(going_on)},
                                      {waiting_, counts_.of(candidates)}});
    }

    enum Queues : std::size_t { going_on, candidates, queues };

    QueueCounts<queues> counts_;
    Rows<PathStateOf> paths_[2]; // of vertex n, and those that go on
    Rows<HitOf> hits_;
    Rows<WaitingOf> waiting_;
};

} // namespace fast
