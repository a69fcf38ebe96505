#pragma once

// With which probability a sample chooses each emitter.
//
// In proportion to power alone, a lamp under a wide sky is almost never chosen, although it may be all
// that lights what the eye sees. So one half of the choices goes by power, and the other half treats all
// emitters alike: a defensive mixture [Hesterberg 1995; Owen and Zhou 2000]. With k emitters none has
// less than 1 / (2 k), and none less than half of what its power alone would give it: no contribution
// becomes larger by more than a factor of 2.

#include <span>
#include <vector>

namespace ref {

/// Cuts the unit interval among emitters of these powers (>= 0, of any unit): number i gets the part
/// from element i - 1 of the result (0 for the first) to element i. All emitters that have power get
/// one, no other does, and the last ends at 1; or all are empty if no emitter has power.
///
/// Every border is a multiple of 2^-24. So an emitter is chosen exactly as often as its part is long,
/// by the uniform numbers of 32 bits here and by those of 24 bits that floats hold, and by both it is
/// the same one. Throws std::invalid_argument if a power is not finite, or if more than 2^24 emitters
/// have one.
std::vector<double> choice_borders(std::span<const double> powers);

} // namespace ref
