#pragma once

// With which probability each emitter is chosen: half in proportion to power, half alike for all, so
// that a small lamp under a wide sky is not starved [Hesterberg 1995].

#include <vector>

namespace fast {

/// The sums of the probabilities of emitters 0 ... i, for emitters of these powers (>= 0); none if no
/// emitter has power. Each is a multiple of 2^-24, which is the grid of uniform numbers in floats: so
/// the probability that is divided by, a difference of two of them, is exactly that of the choice. An
/// emitter that has power has 2^-24 at least; another one has none. The last sum is 1. Throws
/// std::invalid_argument if a power is not finite, or if more than 2^24 emitters have one.
std::vector<float> summed_probabilities(const std::vector<double>& powers);

} // namespace fast
