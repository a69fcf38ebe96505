#pragma once

// Launches of samples in stages, on any executor and in its memory: one block of queues for the whole
// launch. This is how a GPU renders in stages; host_stages.h is the form for the threads of the host,
// with a block for each.

#include "cuda/launch/launch_samples.h"
#include "cuda/parallel/memory.h"
#include "cuda/stages/trace_paths.h"
#include "cuda/stages/trace_walks.h"

namespace fast {

/// An executor whose launches of samples run in stages.
template <Executor E>
class StagedExecutor {
public:
    /// `memory`: that of the kernels of `executor`. Both must outlive this object.
    StagedExecutor(Memory& memory, E& executor) : memory_(memory), executor_(executor) {}

    template <Kernel K>
    void operator()(std::uint32_t count, const K& kernel)
    {
        executor_(count, kernel);
    }
    /// Returns when all queued work is done.
    void wait()
    {
        if constexpr (requires { executor_.wait(); }) executor_.wait(); // others do not queue it
    }

    // As run_stages.h requires.
    static constexpr bool in_parts = true;
    template <class T>
    void clear(std::span<T> elements)
    {
        executor_(static_cast<std::uint32_t>(elements.size()), Clear<T>{elements});
    }
    void read(std::span<const std::uint32_t> from, std::span<std::uint32_t> to)
    {
        wait();
        memory_.read(to.data(), from.data(), from.size_bytes());
    }

    [[nodiscard]] E& executor() const { return executor_; }

private:
    Memory& memory_;
    E& executor_;
};

template <class E>
inline constexpr bool in_stages<StagedExecutor<E>> = true;

template <Executor E>
E& builder_of(StagedExecutor<E>& executor)
{
    return executor.executor();
}

/// The words of memory for the queues of so many samples.
template <Executor E>
std::size_t queue_words(const StagedExecutor<E>& /*executor*/, Integrator integrator,
                        std::uint32_t samples)
{
    switch (integrator) {
    case Integrator::path:
        return PathMemory::words_for(samples);
    case Integrator::bdpt:
        return WalkMemory<Integrator::bdpt>::words_for(samples);
    case Integrator::light:
        break;
    }
    return WalkMemory<Integrator::light>::words_for(samples);
}

/// Computes the samples of a job in stages. Waits between them (trace_paths.h, trace_walks.h), and may
/// return before the last ones are done. Compiled once per integrator and executor, in a file of its
/// own.
template <Integrator integrator, Executor E>
void launch_samples(StagedExecutor<E>& executor, Needs needs, const SceneInMemory& scene,
                    const SampleJob& job)
{
    with_needs(needs, [&]<Needs known>() {
        const StageJob<known> stages{scene.view<known>(), job.options, job.launch, job.film};
        const std::uint32_t count = job.launch.count();
        if constexpr (integrator == Integrator::path)
            PathMemory(job.queues, count).trace(executor, stages, 0, count);
        else
            WalkMemory<integrator>(job.queues, count)
                .trace(executor, stages, 0, count, job.kept, job.capacity);
    });
}

} // namespace fast
