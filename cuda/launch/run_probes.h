#pragma once

#include "cuda/launch/probes.h"
#include "cuda/scene/scene_in_memory.h"

namespace fast {

/// What Kernel{probes, found} finds, with any memory and executor.
template <class Kernel, class Found, class Probe, Executor E>
std::vector<Found> run_probes(Memory& memory, E& executor, std::span<const Probe> probes)
{
    const Buffer<Probe> asked(memory, probes);
    Buffer<Found> found(memory, probes.size());
    executor(static_cast<std::uint32_t>(probes.size()), Kernel{asked.all(), found.all()});
    return found.read(probes.size());
}

/// probe_irradiance with any memory and executor.
template <Executor E>
std::vector<float> run_irradiance(Memory& memory, E& executor, const SceneArrays& arrays,
                                  std::span<const PointProbe> probes)
{
    const SceneInMemory scene(memory, executor, arrays, Camera{});
    const Buffer<PointProbe> asked(memory, probes);
    Buffer<float> found(memory, probes.size());
    executor(static_cast<std::uint32_t>(probes.size()),
             ProbeIrradiance<any_needs>{scene.view<any_needs>(), asked.all(), found.all()});
    return found.read(probes.size());
}

} // namespace fast
