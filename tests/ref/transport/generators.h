#pragma once

// Generators that cover their whole range from the first value on; RapidCheck's own begin near zero.

#include "ref/transport/sampling.h"

#include <rapidcheck.h>

#include <cstdint>

namespace transport_test {

/// Uniform over all 32-bit words.
inline rc::Gen<std::uint32_t> any_word()
{
    return rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint32_t>());
}

/// A number in (0, 1).
inline rc::Gen<double> any_unit()
{
    return rc::gen::map(any_word(), [](std::uint32_t word) { return (word + 0.5) * 0x1p-32; });
}

/// A unit vector.
inline rc::Gen<ref::Vec3> any_direction()
{
    return rc::gen::map(rc::gen::pair(any_unit(), any_unit()), [](const std::pair<double, double>& u) {
        return ref::sample_sphere(u.first, u.second);
    });
}

} // namespace transport_test
