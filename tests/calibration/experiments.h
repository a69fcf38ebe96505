#pragma once

// Measures how often the comparison is wrong, on simulated renders with known truth.

#include "golden/compare.h"
#include "tests/calibration/other_criteria.h"
#include "tests/calibration/simulated_renderer.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace calibration {

/// The number of trials, and of those in which an event happened.
struct Count {
    std::uint64_t hits = 0;
    std::uint64_t trials = 0;
};

/// 95% confidence interval of the rate [Clopper & Pearson 1934].
golden::Interval rate_interval(const Count& count);

/// Called after each trial, from several threads.
using Tick = std::function<void()>;

struct Plan {
    int size = 128;                // width and height in pixels
    std::uint64_t pilot = 512;     // batches of the golden's halves
    std::uint64_t reference = 512; //
    int goldens = 1;
    int trials = 1; // candidates per golden
    std::uint64_t seed = 1;
    std::uint64_t population = 0; // of SimulatedRenderer
    unsigned threads = 1;
    Tick tick = {};
    Layout layout = {};
};

/// The results for right pictures.
struct FalseAlarms {
    Count suspected; // first stages with p below the level of a comparison without further stages
    Count screened;  // and below that of one with a second stage, which is then rendered
    Count failed;    // after all stages
    /// Single tests, of all functionals: p below 1e-3 and 1e-5. The rates should equal these numbers.
    Count below_1e3, below_1e5;
    /// Single tests: p < 1% in the first stage and, in the same direction, in another one of 256
    /// batches.
    Count twice;
    double expected_twice = 0.0; // the rate of `twice` in theory, by all_exceed
};
FalseAlarms measure_false_alarms(Noise noise, const Plan& plan);

/// Numbers of verdicts: by stages of 64 and 256 batches (Method::ranks), for 64 pictures of another
/// renderer (Method::welch), or for one picture of 256 samples (Method::picture).
struct Verdicts {
    std::uint64_t pass = 0, fail = 0, inconclusive = 0;
    /// FAILs by the difference with the smallest p of the first stage. In the others that one was not
    /// confirmed, and another was.
    std::uint64_t by_strongest = 0;
    /// The smallest error that a PASS calls detectable in its least sensitive stratum; infinite if none.
    double least_stated = std::numeric_limits<double>::infinity();
    [[nodiscard]] std::uint64_t trials() const { return pass + fail + inconclusive; }
};
Verdicts measure_verdicts(golden::Method method, Noise golden_noise, Noise candidate_noise,
                          const Bias& bias, const Plan& plan);

/// The results for few pictures of another renderer, each of 64 samples (compare_pictures).
struct FewPictures {
    Verdicts verdicts;
    Count suspected;
    double detectable = 0.0; // median of the detectable errors, least sensitive channel; may be infinite
    double conclusive = 0.0; // mean share of conclusive tests
    Count below_1e3, below_1e5; // single conclusive tests, as in FalseAlarms
};
FewPictures measure_few_pictures(int pictures, Noise golden_noise, Noise candidate_noise,
                                 const Bias& bias, const Plan& plan);

/// For each of other_criteria(): of `plan.trials` pictures of 256 samples with this bias, the number
/// that the criterion finds worse than all but one in a hundred of as many right ones. This is its power
/// with a threshold set for 1% of false alarms.
std::vector<Count> measure_other_criteria(Noise noise, const Bias& bias, const Plan& plan);

} // namespace calibration
