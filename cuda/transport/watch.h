#pragma once

// Sinks that want to see the walks themselves, and not only what they contribute. Tests do: what each
// step made of the last can then be judged by itself. Where a sink does not watch, nothing is left of
// it.

#include "cuda/transport/subpath.h"

namespace gpu {

/// Is shown how the light walk begins, every surface that a walk meets, and the leg that meets none.
template <class Sink>
concept WatchesWalks = requires(Sink& sink, const SampledEmission& emission, const WalkVertex& vertex,
                                const Leg& leg)
{
    sink.emits(emission);
    sink.meets(Transport::power, vertex);
    sink.misses(Transport::power, leg);
};

template <class Sink>
HD void show_emission(Sink& sink, const SampledEmission& emission)
{
    if constexpr (WatchesWalks<Sink>) sink.emits(emission);
}

template <class Sink>
HD void show_vertex(Sink& sink, Transport carried, const WalkVertex& vertex)
{
    if constexpr (WatchesWalks<Sink>) sink.meets(carried, vertex);
}

template <class Sink>
HD void show_miss(Sink& sink, Transport carried, const Leg& leg)
{
    if constexpr (WatchesWalks<Sink>) sink.misses(carried, leg);
}

} // namespace gpu
