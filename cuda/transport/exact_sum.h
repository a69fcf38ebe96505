#pragma once

// A sum of floats without any rounding [Kulisch], so that it does not depend on the order of its
// terms. It is a fixed-point number so wide that it can represent every float. Carries are delayed:
// each word keeps 32 bits of the number in 64 bits, and so has room for 2^32 terms.

#include "cuda/parallel/atomic.h"

#include <bit>
#include <cmath>
#include <limits>

namespace fast {

/// The sum of up to 2^32 floats >= 0. All zero bytes are the empty sum.
struct ExactSum {
    std::uint64_t words[9]; // word w counts in units of 2^(32 w - 149)
    std::uint64_t lost;     // terms that were infinite, NaN or negative

    /// Adds `term`. May be called from any number of threads.
    HD void add(float term)
    {
        const auto bits = std::bit_cast<std::uint32_t>(term);
        if (bits == 0 || bits == 0x8000'0000) return;
        const std::uint32_t exponent = bits >> 23; // with the sign
        if (exponent >= 255) {
            fast::add(lost, 1);
            return;
        }
        // term = mantissa 2^(place - 149); subnormal numbers have no hidden bit and also have place 0.
        const std::uint32_t hidden = exponent > 0 ? 1u << 23 : 0u;
        const std::uint64_t mantissa = (bits & 0x7f'ffff) | hidden;
        const std::uint32_t place = exponent > 0 ? exponent - 1 : 0;
        const std::uint64_t shifted = mantissa << (place % 32);
        fast::add(words[place / 32], shifted & 0xffff'ffff);
        if ((shifted >> 32) != 0) fast::add(words[place / 32 + 1], shifted >> 32);
    }

    /// The sum, to within a few units of the last place of a double. It is the same for the same terms
    /// in any order, and NaN if a term was lost.
    [[nodiscard]] double value() const
    {
        if (lost != 0) return std::numeric_limits<double>::quiet_NaN();
        double sum = 0;
        for (int w = 0; w < 9; ++w) sum += std::ldexp(static_cast<double>(words[w]), 32 * w - 149);
        return sum;
    }
};

} // namespace fast
