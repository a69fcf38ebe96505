#pragma once

// The result of one test: one functional (a region and a weight) in one channel, candidate against
// golden.

#include "golden/functionals.h"
#include "golden/statistics.h"

#include <cstddef>
#include <limits>
#include <string>

namespace golden {

/// The error that more samples make detectable: the candidate's noise vanishes with its samples, the
/// golden's stays.
struct Reach {
    double limit = std::numeric_limits<double>::quiet_NaN(); // `detectable` of a candidate without noise
    /// The factor by which the candidate's batches must grow so that an error of the specified size is
    /// detectable; infinite if the golden's noise hides it.
    double candidate = std::numeric_limits<double>::quiet_NaN();
    /// The factor by which the golden's batches must grow so that its variance is half of what is
    /// allowed.
    double golden = std::numeric_limits<double>::quiet_NaN();
};

/// The result of the first stage for one functional in one channel.
struct Finding {
    Region region;
    Weight weight;
    std::size_t functional; // its number among the golden's functionals
    std::size_t channel;    // 0 red, 1 green, 2 blue
    bool conclusive;        // false: no t test is possible here, so its p is not used
    TestResult test;        // z > 0: the candidate is brighter
    double adjusted_p;      // Bonferroni over channels, families and the members of the family
    double ratio;           // candidate / golden, of the functional's values; NaN where the golden is 0
    Interval interval;      // of the ratio
    double detectable;      // smallest relative error found with the stated power; NaN if not defined
    Reach reach = {};       // of the whole picture, by t tests
    /// By t tests: too dark. Either light is missing, or the batches have fewer of the rare events of
    /// this estimator than usual; then their variance and skewness are too small as well.
    bool darker_by_means = false;
    /// The adjusted p that must be below the certainty level for FAIL at once. It is adjusted_p, or
    /// larger for few pictures of which only few pixels show how large their noise is.
    double certain_p = 1.0;
    /// The part of `detectable` that rare events may hide, which few pictures with far less noise than
    /// the golden may lack (rare_events.h).
    double hidden = 0.0;
};

/// "green of tile x 16..31, y 0..15 (matched)"
std::string describe(const Finding& finding);

/// "green in the tile x 16..31, y 0..15": where it is, for people who do not know the weights.
std::string describe_place(const Finding& finding);

} // namespace golden
