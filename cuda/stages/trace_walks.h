#pragma once

// The loops over the stages of bidirectional path tracing and of light tracing.

#include "cuda/stages/bdpt_stages.h"
#include "cuda/stages/run_stages.h"

#include <algorithm>
#include <utility>

namespace fast {

/// The memory for the unfinished walks of a block.
template <Integrator integrator>
class WalkMemory {
    static constexpr bool with_eye_walks = integrator == Integrator::bdpt;
    enum Queues : std::size_t { going_on, candidates, eye_vertices, queues };

public:
    /// For up to `capacity` samples. `words`: words_for(capacity), in the memory of the stages.
    WalkMemory(std::span<std::uint32_t> words, std::uint32_t capacity)
    {
        WordPool pool(words);
        counts_ = QueueCounts<queues>(pool);
        for (Rows<WalkStateOf>& rows : walks_) rows = pool.rows<Rows<WalkStateOf>>(capacity);
        hits_ = pool.rows<Rows<HitOf>>(capacity);
        splats_ = pool.rows<Rows<WaitingSplatOf>>(capacity);
        if constexpr (with_eye_walks) {
            vertices_of_samples_ = pool.take(capacity);
            waiting_ = pool.rows<Rows<WaitingOf>>(capacity);
            eye_vertices_ = pool.rows<Rows<StoredEyeVertexOf>>(capacity);
        }
    }
    static constexpr std::size_t words_for(std::uint32_t capacity)
    {
        return QueueCounts<queues>::words + 2 * Rows<WalkStateOf>::words_for(capacity) +
               Rows<HitOf>::words_for(capacity) + Rows<WaitingSplatOf>::words_for(capacity) +
               (with_eye_walks ? capacity + Rows<WaitingOf>::words_for(capacity) +
                                     Rows<StoredEyeVertexOf>::words_for(capacity)
                               : 0);
    }

    /// Traces the samples first_slot ... first_slot + count - 1 of a launch. `run`: run_stages.h.
    /// `kept`: memory for `most_vertices` light vertices of each sample; only Integrator::bdpt uses it.
    /// Reads counts once for each vertex of the longest walk, and for each s to which an eye vertex is
    /// joined. A stage that has nothing to do is not run.
    template <Needs needs, class Run>
    void trace(Run& run, const StageJob<needs>& job, std::uint32_t first_slot, std::uint32_t count,
               std::span<LightVertex> kept, int most_vertices)
    {
        run.clear(job.film.own.subspan(first_slot, count));
        const BlockVertices block{first_slot, count, kept, vertices_of_samples_};
        int longest = 0; // light walk, in vertices after y_0
        if (!job.scene.cumulative.empty()) longest = trace_light(run, job, block, most_vertices);
        if constexpr (with_eye_walks) trace_eye(run, job, block, longest);
    }

private:
    template <Needs needs, class Run>
    int trace_light(Run& run, const StageJob<needs>& job, const BlockVertices& block, int most_vertices)
    {
        const int last = (with_eye_walks ? std::min(job.options.max_edges, most_vertices + 1)
                                         : job.options.max_edges) -
                         1;
        if constexpr (with_eye_walks) run.clear(vertices_of_samples_.first(block.samples));
        counts_.clear(run);
        if constexpr (Run::in_parts && needs.coincident) {
            generate_light<Part::joins>(run, job, block);
            generate_light<Part::bounce>(run, job, block);
        } else {
            generate_light<Part::all>(run, job, block);
        }
        auto filled = counts_.read(run);
        test_splats(run, job, 1, filled[candidates]);
        int n = 1;
        for (; n <= last && filled[going_on] > 0; ++n) {
            run(filled[going_on], Extend<needs, WalkStateOf>{job, walks_[0], hits_});
            counts_.clear(run);
            if constexpr (Run::in_parts) {
                shade_light<Part::joins>(run, job, block, n, last, filled[going_on]);
                if (n < last) shade_light<Part::bounce>(run, job, block, n, last, filled[going_on]);
            } else {
                shade_light<Part::all>(run, job, block, n, last, filled[going_on]);
            }
            filled = counts_.read(run);
            test_splats(run, job, n + 1, filled[candidates]);
            std::swap(walks_[0], walks_[1]);
        }
        return n - 1;
    }

    template <Part part, Needs needs, class Run>
    void generate_light(Run& run, const StageJob<needs>& job, const BlockVertices& block)
    {
        run(block.samples,
            GenerateLight<needs, integrator, part>{
                job, block, {walks_[0], counts_.of(going_on)}, {splats_, counts_.of(candidates)}});
    }

    template <Part part, Needs needs, class Run>
    void shade_light(Run& run, const StageJob<needs>& job, const BlockVertices& block, int n, int last,
                     std::uint32_t count)
    {
        run(count, ShadeLight<needs, integrator, part>{job,
                                                       n,
                                                       n == last,
                                                       block,
                                                       walks_[0],
                                                       hits_,
                                                       {walks_[1], counts_.of(going_on)},
                                                       {splats_, counts_.of(candidates)}});
    }

    template <Needs needs, class Run>
    void test_splats(Run& run, const StageJob<needs>& job, int s, std::uint32_t count)
    {
        if (count > 0) run(count, TestSplat<needs>{job, s, splats_});
    }

    template <Needs needs, class Run>
    void trace_eye(Run& run, const StageJob<needs>& job, const BlockVertices& block, int longest)
    {
        run(block.samples, GenerateEye<needs>{job, block.first_slot, walks_[0]});
        std::uint32_t count = block.samples;
        for (int n = 1; count > 0; ++n) {
            run(count, Extend<needs, WalkStateOf>{job, walks_[0], hits_});
            counts_.clear(run);
            if constexpr (Run::in_parts) {
                if (n < job.options.max_edges && !job.scene.cumulative.empty())
                    shade_eye<Part::joins>(run, job, n, count);
                shade_eye<Part::bounce>(run, job, n, count);
            } else {
                shade_eye<Part::all>(run, job, n, count);
            }
            if (n == job.options.max_edges) return; // no bounce and nothing to join
            const auto filled = counts_.read(run);
            test_shadows(run, job, 1, n + 1, filled[candidates]);
            if (filled[eye_vertices] > 0)
                for (int s = 2; s <= longest + 1 && s + n <= job.options.max_edges; ++s)
                    connect(run, job, block, n, s, filled[eye_vertices]);
            std::swap(walks_[0], walks_[1]);
            count = filled[going_on];
        }
    }

    template <Part part, Needs needs, class Run>
    void shade_eye(Run& run, const StageJob<needs>& job, int n, std::uint32_t count)
    {
        run(count, ShadeEye<needs, part>{job,
                                         n,
                                         walks_[0],
                                         hits_,
                                         {walks_[1], counts_.of(going_on)},
                                         {waiting_, counts_.of(candidates)},
                                         {eye_vertices_, counts_.of(eye_vertices)}});
    }

    template <Needs needs, class Run>
    void connect(Run& run, const StageJob<needs>& job, const BlockVertices& block, int n, int s,
                 std::uint32_t count)
    {
        counts_.clear(run);
        run(count, Connect<needs>{job, n, s, block, eye_vertices_, {waiting_, counts_.of(candidates)}});
        test_shadows(run, job, s, n + 1, counts_.read(run)[candidates]);
    }

    template <Needs needs, class Run>
    void test_shadows(Run& run, const StageJob<needs>& job, int s, int t, std::uint32_t count)
    {
        if (count > 0) run(count, TestShadow<needs>{job, s, t, waiting_});
    }

    QueueCounts<queues> counts_;
    Rows<WalkStateOf> walks_[2]; // at vertex n, and those that go on
    Rows<HitOf> hits_;
    Rows<WaitingSplatOf> splats_;
    // Of eye walks only.
    std::span<std::uint32_t> vertices_of_samples_; // of their light walks
    Rows<WaitingOf> waiting_;
    Rows<StoredEyeVertexOf> eye_vertices_;
};

} // namespace fast
