#pragma once

// One launch of a kernel over an array, with any memory and executor.

#include "cuda/scene/scene_in_memory.h"

#include <span>
#include <vector>

namespace fast {

/// What Kernel{probes, found} finds.
template <class Kernel, class Found, class Probe, Executor E>
std::vector<Found> run_probes(Memory& memory, E& executor, std::span<const Probe> probes)
{
    const Buffer<Probe> asked(memory, probes);
    Buffer<Found> found(memory, probes.size());
    executor(static_cast<std::uint32_t>(probes.size()), Kernel{asked.all(), found.all()});
    return found.read(probes.size());
}

/// What Kernel<any_needs>{scene, probes, found} finds.
template <template <Needs> class Kernel, class Found, class Probe, Executor E>
std::vector<Found> run_probes_in_scene(Memory& memory, E& executor, const SceneArrays& arrays,
                                       std::span<const Probe> probes)
{
    const SceneInMemory scene(memory, executor, arrays, Camera{});
    const Buffer<Probe> asked(memory, probes);
    Buffer<Found> found(memory, probes.size());
    executor(static_cast<std::uint32_t>(probes.size()),
             Kernel<any_needs>{scene.view<any_needs>(), asked.all(), found.all()});
    return found.read(probes.size());
}

} // namespace fast
