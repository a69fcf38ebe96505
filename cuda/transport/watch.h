#pragma once

// Sinks that receive the steps of the walks in addition to the contributions. Tests use this to
// compare every step of a walk with the reference. For other sinks, these functions compile to
// nothing.

#include "cuda/transport/emission.h"
#include "cuda/transport/subpath.h"

namespace fast {

/// Receives the start of the light walk, every surface that a walk hits, and the leg that hits none.
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

} // namespace fast
