#pragma once

// Sinks that are shown the walks themselves, and not only what they contribute. Tests need this, to
// compare every step of a walk with the reference. For a sink that does not watch, these functions
// compile to nothing.

#include "cuda/transport/emission.h"
#include "cuda/transport/subpath.h"

namespace fast {

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

} // namespace fast
