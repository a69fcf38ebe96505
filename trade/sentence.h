#pragma once

// What the numbers of a knob say, in a sentence.

#include "trade/estimates.h"
#include "trade/study.h"

#include <optional>
#include <string>
#include <vector>

namespace trade {

/// The gain or loss of the values of a knob beside its reference, and which of them are biased.
/// Intervals are of 95%; a value is called faster or slower only if an interval that all configurations
/// of the study share excludes 1 [Bonferroni 1936]: else one in twenty comparisons of equal ones would
/// be called so. `estimates`: by configuration; none where there are too few measurements. `measured` in
/// the same order.
std::string sentence(const Knob& knob, const std::vector<std::optional<Estimates>>& estimates,
                     const std::vector<Measurements>& measured);

} // namespace trade
