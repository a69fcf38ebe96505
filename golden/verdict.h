#pragma once

// From findings to a verdict.

#include "golden/compare_options.h"
#include "golden/comparison.h"
#include "golden/golden.h"

#include <string>

namespace golden {

/// Computes suspicion, p, detectable, least_sensitive_stratum and coverage from the findings.
void summarise(Comparison& comparison);

/// Computes golden_limit and shortfall from the findings of t tests. After summarise.
void summarise_reach(Comparison& comparison, const Golden& golden, const CompareOptions& options);

/// The verdict if no difference is found: PASS if an error of the specified size is detectable, else
/// INCONCLUSIVE. `remark` ends the reason.
void pass_or_inconclusive(Comparison& comparison, const CompareOptions& options,
                          const std::string& remark = "");

/// FAIL for the suspicion. `how` follows the description of the suspicion in the reason.
void fail(Comparison& comparison, const std::string& how);

/// Sets the verdict if the first stage is enough for one; false if the suspicion needs another stage.
/// `can_render_again`: another stage is possible. Then a finding that is darker_by_means is not enough
/// for FAIL.
bool decide_at_once(Comparison& comparison, const CompareOptions& options,
                    bool can_render_again = false);

/// For a picture that is INCONCLUSIVE and has a few pixels far brighter than the golden's: FAIL if the
/// comparison `without` these pixels is too bright at the certainty level. Else it stays INCONCLUSIVE;
/// if only these pixels prevent a verdict, the reason states the one without them.
void decide_without(Comparison& comparison, const Comparison& without, const CompareOptions& options);

} // namespace golden
