#pragma once

// Random numbers as a function of a counter, not as a sequence: Philox4x32-10 [Salmon 2011] from the
// Random123 library. Every decision of every sample has its own counter block, so any sample of any
// picture can be computed alone, in any order and on any machine.

#include <Random123/philox.h>

#include <array>
#include <cstdint>

namespace ref {

/// The event that a block of random numbers decides. `next_event` and the bounces also carry the
/// vertex index.
enum class Event : std::uint32_t {
    camera,             // position within the pixel (2)
    emission_position,  // emitter, point on it (3)
    emission_direction, // direction from it (2)
    eye_bounce,         // direction (2), lobe, roulette, at eye vertex j
    light_bounce,       // the same at light vertex j
    next_event,         // emitter, point on it (3), for eye vertex j
};

/// Four numbers in (0, 1): the midpoints of 2^32 equal cells, so neither 0 nor 1 occurs.
using Uniforms = std::array<double, 4>;

/// Identifies one sample of one pixel of one picture.
struct SampleId {
    std::uint64_t seed;
    std::uint32_t pixel; // y * width + x
    std::uint32_t sample;
};

/// The random numbers of `event` at vertex `j` (0 <= j < 2^24; 0 for events that have no vertex).
inline Uniforms uniforms(const SampleId& id, Event event, std::uint32_t j = 0)
{
    const philox4x32_key_t key = {
        {static_cast<std::uint32_t>(id.seed), static_cast<std::uint32_t>(id.seed >> 32)}};
    const philox4x32_ctr_t counter = {
        {id.pixel, id.sample, static_cast<std::uint32_t>(event) << 24 | j, 0}};
    const philox4x32_ctr_t words = philox4x32(counter, key);
    Uniforms result{};
    for (std::size_t i = 0; i < 4; ++i) result[i] = (words.v[i] + 0.5) * 0x1p-32; // map: random-numbers
    return result;
}

} // namespace ref
