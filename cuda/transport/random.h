#pragma once

// Random numbers as a function of a counter: Philox4x32-10 [Salmon et al. 2011] from the Random123
// library. The counter blocks are those of the reference (key: seed; counter: pixel, sample, event and
// vertex, 0), so that a sample makes the same decisions here as there.

#include "cuda/parallel/number.h"

#include <Random123/philox.h>

#include <cstdint>

namespace fast {

/// The event that a block of random numbers decides, numbered as in the reference.
enum class Event : std::uint32_t {
    camera,             // position within the pixel (2)
    emission_position,  // emitter, point on it (3)
    emission_direction, // direction from it (2)
    eye_bounce,         // direction (2), lobe, roulette, at eye vertex j
    light_bounce,       // the same at light vertex j
    next_event,         // emitter, point on it (3), for eye vertex j
};

/// Four numbers in [0, 1): the highest 24 bits of each word, which a float holds exactly. Each is less
/// than 2^-24 below the number that the reference makes from all 32 bits.
template <class F>
struct UniformsOf {
    F u[4];
    HD const F& operator[](int i) const { return u[i]; }
};
using Uniforms = UniformsOf<float>;

/// Identifies one sample of one pixel of one picture.
template <class F>
struct SampleIdOf {
    std::uint64_t seed;
    WordOf<F> pixel; // y * width + x
    WordOf<F> sample;
};
using SampleId = SampleIdOf<float>;

/// The random numbers of `event` at vertex `j` (0 <= j < 2^24; 0 for events that have no vertex).
HD inline Uniforms uniforms(const SampleId& id, Event event, std::uint32_t j = 0)
{
    const philox4x32_key_t key = {
        {static_cast<std::uint32_t>(id.seed), static_cast<std::uint32_t>(id.seed >> 32)}};
    const philox4x32_ctr_t counter = {
        {id.pixel, id.sample, static_cast<std::uint32_t>(event) << 24 | j, 0}};
    const philox4x32_ctr_t words = philox4x32(counter, key);
    Uniforms result{};
    // map: random-numbers
    for (int i = 0; i < 4; ++i) result.u[i] = static_cast<float>(words.v[i] >> 8) * 0x1p-24f;
    return result;
}

} // namespace fast
