#pragma once

// The loops over the stages of bidirectional path tracing and of light tracing.

#include "cuda/stages/bdpt_stages.h"

#include <algorithm>
#include <utility>

namespace fast {

/// The memory for the unfinished walks of a block.
class WalkMemory {
public:
    /// For up to `capacity` samples. `words`: words_for(capacity).
    WalkMemory(std::span<std::uint32_t> words, std::uint32_t capacity)
    {
        const auto take = [&](std::size_t count) {
            const std::span<std::uint32_t> taken = words.first(count);
            words = words.subspan(count);
            return taken;
        };
        counts_ = take(4 * counts_apart);
        vertices_of_samples_ = take(capacity);
        for (Rows<WalkStateOf>& rows : walks_)
            rows = {take(Rows<WalkStateOf>::words_for(capacity)), capacity};
        hits_ = {take(Rows<HitOf>::words_for(capacity)), capacity};
        waiting_ = {take(Rows<WaitingOf>::words_for(capacity)), capacity};
        splats_ = {take(Rows<WaitingSplatOf>::words_for(capacity)), capacity};
        eye_vertices_ = {take(Rows<StoredEyeVertexOf>::words_for(capacity)), capacity};
    }
    static constexpr std::size_t words_for(std::uint32_t capacity)
    {
        return 4 * counts_apart + capacity + 2 * Rows<WalkStateOf>::words_for(capacity) +
               Rows<HitOf>::words_for(capacity) + Rows<WaitingOf>::words_for(capacity) +
               Rows<WaitingSplatOf>::words_for(capacity) + Rows<StoredEyeVertexOf>::words_for(capacity);
    }

    /// Traces the samples first_slot ... first_slot + count - 1 of a launch. `run` executes each stage
    /// and returns when it is done. `kept`: memory for `most_vertices` light vertices of each sample;
    /// only Integrator::bdpt uses it.
    template <Integrator integrator, Needs needs, class Run>
    void trace(Run&& run, const StageJob<needs>& job, std::uint32_t first_slot, std::uint32_t count,
               std::span<LightVertex> kept, int most_vertices)
    {
        for (std::uint32_t i = 0; i < count; ++i) job.film.own[first_slot + i] = Rgb(0.0f);
        const BlockVertices block{first_slot, count, kept, vertices_of_samples_};
        std::fill_n(vertices_of_samples_.begin(), count, 0u);
        int longest = 0; // light walk, in vertices after y_0
        if (!job.scene.cumulative.empty())
            longest = trace_light<integrator>(run, job, block, most_vertices);
        if constexpr (integrator == Integrator::bdpt) trace_eye(run, job, block, longest);
    }

private:
    template <Integrator integrator, Needs needs, class Run>
    int trace_light(Run& run, const StageJob<needs>& job, const BlockVertices& block, int most_vertices)
    {
        const int last =
            (integrator == Integrator::bdpt ? std::min(job.options.max_edges, most_vertices + 1)
                                            : job.options.max_edges) -
            1;
        going_on() = 0;
        candidates() = 0;
        run(block.samples, GenerateLight<needs, integrator>{
                               job, block, {walks_[0], &going_on()}, {splats_, &candidates()}});
        run(candidates(), TestSplat<needs>{job, 1, splats_});
        int n = 1;
        for (std::uint32_t count = going_on(); n <= last && count > 0; ++n, count = going_on()) {
            going_on() = 0;
            candidates() = 0;
            run(count, Extend<needs, WalkStateOf>{job, walks_[0], hits_});
            run(count, ShadeLight<needs, integrator>{job,
                                                     n,
                                                     n == last,
                                                     block,
                                                     walks_[0],
                                                     hits_,
                                                     {walks_[1], &going_on()},
                                                     {splats_, &candidates()}});
            run(candidates(), TestSplat<needs>{job, n + 1, splats_});
            std::swap(walks_[0], walks_[1]);
        }
        return n - 1;
    }

    template <Needs needs, class Run>
    void trace_eye(Run& run, const StageJob<needs>& job, const BlockVertices& block, int longest)
    {
        run(block.samples, GenerateEye<needs>{job, block.first_slot, walks_[0]});
        std::uint32_t count = block.samples;
        for (int n = 1; n <= job.options.max_edges && count > 0; ++n, count = going_on()) {
            going_on() = 0;
            candidates() = 0;
            eye_vertices() = 0;
            run(count, Extend<needs, WalkStateOf>{job, walks_[0], hits_});
            run(count, ShadeEye<needs>{job,
                                       n,
                                       walks_[0],
                                       hits_,
                                       {walks_[1], &going_on()},
                                       {waiting_, &candidates()},
                                       {eye_vertices_, &eye_vertices()}});
            run(candidates(), TestShadow<needs>{job, 1, n + 1, waiting_});
            for (int s = 2; s <= longest + 1 && s + n <= job.options.max_edges; ++s) {
                candidates() = 0;
                run(eye_vertices(),
                    Connect<needs>{job, n, s, block, eye_vertices_, {waiting_, &candidates()}});
                run(candidates(), TestShadow<needs>{job, s, n + 1, waiting_});
            }
            std::swap(walks_[0], walks_[1]);
        }
    }

    static constexpr std::size_t counts_apart = 16; // a cache line
    [[nodiscard]] std::uint32_t& going_on() { return counts_[0]; }
    [[nodiscard]] std::uint32_t& candidates() { return counts_[counts_apart]; }
    [[nodiscard]] std::uint32_t& eye_vertices() { return counts_[2 * counts_apart]; }

    std::span<std::uint32_t> counts_;
    std::span<std::uint32_t> vertices_of_samples_;
    Rows<WalkStateOf> walks_[2]; // at vertex n, and those that go on
    Rows<HitOf> hits_;
    Rows<WaitingOf> waiting_;
    Rows<WaitingSplatOf> splats_;
    Rows<StoredEyeVertexOf> eye_vertices_;
};

} // namespace fast
