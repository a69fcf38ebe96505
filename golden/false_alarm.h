#pragma once

// The chance that a right picture fails.

#include "golden/compare_options.h"
#include "golden/functionals.h"
#include "golden/method.h"

#include <cstdint>
#include <vector>

namespace golden {

/// Upper bound of the chance that a right picture fails. `stages`: the batches of each stage; with one
/// stage it is the certainty level. All stages share the error of the golden, so the bound integrates
/// over that error (docs/comparison.md, section 6). It assumes normally distributed means, which those
/// of a few dozen batches nearly are, and adds the chances of all functionals.
double false_alarm_bound(const Functionals& functionals, Method method, std::uint64_t golden_batches,
                         const std::vector<std::uint64_t>& stages, const CompareOptions& options);

} // namespace golden
