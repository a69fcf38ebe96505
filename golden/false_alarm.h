#pragma once

// The chance that a right picture fails.

#include "golden/compare_options.h"
#include "golden/functionals.h"
#include "golden/method.h"

#include <cstdint>
#include <vector>

namespace golden {

/// Upper bound of the chance that a right picture fails. `stages` are the batches of each; with one
/// stage only the certainty level counts. All stages are compared with the same golden, whose own error
/// they share: the bound is an integral over that error, for means that are normally distributed as
/// those of a few dozen batches nearly are, summed over all functionals as if none knew of another.
double false_alarm_bound(const Functionals& functionals, Method method, std::uint64_t golden_batches,
                         const std::vector<std::uint64_t>& stages, const CompareOptions& options);

} // namespace golden
