#pragma once

// FAIL of few pictures.

#include "golden/comparison.h"
#include "golden/golden.h"

#include <cstddef>

namespace check {

/// Whether a FAIL is certain. Welch's degrees of freedom count those of the golden as well, in
/// proportion to the variances that are found. Of few pictures the variance can be far too small by
/// chance; then it seems that the golden's noise is all there is, with all its degrees. The degrees of
/// the pictures alone, or of the golden if those are fewer, are never too many [Hsu 1938].
bool is_certain(const golden::Golden& golden, const golden::Comparison& comparison,
                std::size_t pictures);

} // namespace check
