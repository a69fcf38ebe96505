#pragma once

// The seeds that renderers get.

#include <cstdint>

namespace check {

/// The seed of picture `number`, from 1 on, of a series. It lies between 1 and 2^31 - 2, so that every
/// renderer can read it. The seeds of a series of 1000 are at least two million apart: many renderers
/// add the number of a thread or a pixel to their seed, and would give two neighbouring seeds the same
/// random numbers in other places.
inline std::uint64_t seed_of(std::uint64_t series, std::uint64_t number)
{
    constexpr std::uint64_t modulus = (std::uint64_t{1} << 31) - 1; // prime
    constexpr std::uint64_t step = 2'097'169;                       // modulus / 1024, and a little
    constexpr std::uint64_t series_step = 1'234'567'891;
    return 1 + ((series % modulus) * series_step + number * step) % (modulus - 1);
}

} // namespace check
