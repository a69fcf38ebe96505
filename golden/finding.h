#pragma once

// The result of one test: is one region, seen through one weight in one channel, as bright as in the
// golden?

#include "golden/functionals.h"
#include "golden/statistics.h"

#include <cstddef>
#include <limits>
#include <string>

namespace golden {

/// How far more samples lead: the candidate's noise vanishes with them, the golden's stays.
struct Reach {
    double limit = std::numeric_limits<double>::quiet_NaN(); // `detectable` of a candidate without noise
    /// So many times the candidate's batches show an error of the specified size; infinite if the
    /// golden's noise hides it.
    double candidate = std::numeric_limits<double>::quiet_NaN();
    /// So many times the golden's batches leave half of the noise that is allowed to the candidate.
    double golden = std::numeric_limits<double>::quiet_NaN();
};

/// What the first stage says about one region, seen through one weight in one channel.
struct Finding {
    Region region;
    Weight weight;
    std::size_t functional; // its number among the golden's functionals
    std::size_t channel;    // 0 red, 1 green, 2 blue
    bool conclusive;        // false: too skewed for a t test. It then counts for nothing
    TestResult test;        // z > 0: the candidate is brighter
    double adjusted_p;      // Bonferroni over channels, families and the members of the family
    double ratio;           // candidate / golden, of the functional's values; NaN where the golden is 0
    Interval interval;      // of the ratio
    double detectable;      // smallest relative error found with the stated power; NaN if not defined
    Reach reach = {};       // of the whole picture, by t tests
    /// By t tests: all batches are alike and too dark. It may be that light is missing, or that no batch
    /// has an event that is rare for this estimator; then the variance, 0, says nothing of it.
    bool darker_without_noise = false;
};

/// "green of tile x 16..31, y 0..15 (matched)"
std::string describe(const Finding& finding);

} // namespace golden
