#pragma once

// From findings to a verdict, and to the sentences that give its reason.

#include "golden/compare.h"

#include <string>

namespace golden {

/// Fills in what follows from the findings: suspicion, p, what is detectable, coverage.
void summarise(Comparison& comparison);

/// A number or a fraction in percent with a few digits.
std::string say(double number, int digits);
std::string say_percent(double fraction);

/// "green of tile ... is 0.98 times the golden's (0.97 to 0.99), p = 1e-7"
std::string say_suspicion(const Comparison& comparison);

/// The verdict where nothing is found: PASS if an error of the specified size would have been,
/// INCONCLUSIVE if not. `remark` ends the reason.
void acquit(Comparison& comparison, const CompareOptions& options, const std::string& remark = "");

/// FAIL for the suspicion; `how` goes on from it.
void convict(Comparison& comparison, const std::string& how);

/// The verdict of the first stage if it is already certain; false if the suspicion needs another look.
bool decide_at_once(Comparison& comparison, const CompareOptions& options);

} // namespace golden
