#pragma once

// Adds contributions of stages to their samples.

#include "cuda/transport/film_sink.h"
#include "cuda/transport/render_samples.h"

namespace fast {

/// Where `mask`, adds to the sample with index `slot` of the launch, as FilmSink::add does.
HD inline void film_add(const FilmTarget& film, const Launch& launch, bool mask, std::uint32_t slot,
                        int s, int t, const Rgb& value, float weight)
{
    if (!mask) return;
    FilmSink sink(film, launch.first_pixel + slot % launch.pixels);
    sink.add(s, t, value, weight);
    film.own[slot] += sink.own();
}

/// Where `mask`, adds to any pixel as FilmSink::splat does.
HD inline void film_splat(const FilmTarget& film, bool mask, std::uint32_t pixel, int s,
                          const Rgb& value, float weight)
{
    if (mask) FilmSink(film, pixel).splat(pixel, s, value, weight);
}

} // namespace fast
