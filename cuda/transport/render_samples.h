#pragma once

// The kernel: one thread computes one whole sample of one pixel.

#include "cuda/transport/bdpt.h"
#include "cuda/transport/film_sink.h"

namespace fast {

/// The samples of a launch: index i is pixel first_pixel + i % pixels, sample first_sample + i /
/// pixels.
struct Launch {
    std::uint32_t first_pixel, pixels;
    std::uint32_t first_sample, samples;
    [[nodiscard]] HD std::uint32_t count() const { return pixels * samples; }
};

/// Kernel over the samples of a launch.
template <Needs needs, Integrator integrator>
struct RenderSamples {
    SceneView<needs> scene;
    PathOptions options;
    Launch launch;
    FilmTarget film;
    std::span<LightVertex> kept; // of all samples of the launch
    int capacity;                // of each sample

    HD void operator()(std::uint32_t index) const
    {
        const SampleId id{options.seed, launch.first_pixel + index % launch.pixels,
                          launch.first_sample + index / launch.pixels};
        FilmSink sink(film, id.pixel);
        trace_sample<needs, integrator>(scene, options, id,
                                        {kept.data() + index, launch.count(), capacity}, sink);
        film.own[index] = sink.own();
    }
};

} // namespace fast
