#pragma once

// From findings to a verdict.

#include "golden/compare_options.h"
#include "golden/comparison.h"
#include "golden/golden.h"

#include <string>

namespace golden {

/// Fills in what follows from the findings: suspicion, p, what is detectable, coverage.
void summarise(Comparison& comparison);

/// Fills in, from the findings of t tests, how far more samples than comparison.candidate_batches would
/// lead: golden_limit and shortfall. After summarise.
void summarise_reach(Comparison& comparison, const Golden& golden, const CompareOptions& options);

/// The verdict where nothing is found: PASS if an error of the specified size would have been,
/// INCONCLUSIVE if not. `remark` ends the reason.
void pass_or_inconclusive(Comparison& comparison, const CompareOptions& options,
                          const std::string& remark = "");

/// FAIL for the suspicion; `how` goes on from it.
void fail(Comparison& comparison, const std::string& how);

/// The verdict of the first stage if it is already certain; false if the suspicion needs another look.
/// `can_render_again`: a fresh stage follows. Then light that all batches lack alike is not missing
/// for certain (Finding::darker_without_noise).
bool decide_at_once(Comparison& comparison, const CompareOptions& options,
                    bool can_render_again = false);

/// Decides on a picture that was inconclusive and has a few pixels far brighter than the golden's, by
/// the comparison `without` them: FAIL if that is too bright all the same. Else it stays INCONCLUSIVE,
/// and the reason says what is found without them if they were what hindered.
void decide_without(Comparison& comparison, const Comparison& without, const CompareOptions& options);

} // namespace golden
