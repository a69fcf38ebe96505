#pragma once

// One question to a candidate, and its answer: is this region, seen through this weight, as bright as in
// the golden?

#include "golden/functionals.h"
#include "golden/golden.h"
#include "golden/statistics.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace golden {

/// What is known of the candidate's noise, and so how means are compared.
enum class Method {
    ranks,  // same estimator, same batch size: batches are distributed alike. Mann-Whitney
    welch,  // another estimator, of which there are several independent pictures. Welch's t
    picture // a single picture with a stated number of samples. Welch's t with an assumed noise
};
std::string describe(Method method);

struct CompareOptions {
    double accuse = 0.05;         // chance that a right picture's first stage finds something to confirm
    double confirm = 1e-7;        // level of each later stage, at which one suspicion alone is tested
    double convict = 1e-8;        // level at which one stage is enough for FAIL
    double dark = 1e-9;           // level at which pixels that are too dark are enough for FAIL
    double specification = 0.005; // relative error of the whole picture that must be detectable to pass
    double power = 0.99;          // with this probability
    double confidence = 0.99;     // of the intervals of ratios
    double rounding = 2e-6;       // relative difference that is put down to single precision
    double skewness = 0.15;       // |skewness| / sqrt(batches) up to which a t test is believed
    std::vector<std::uint64_t> stages = {64, 256}; // batches of each
};

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

/// How many tests share the chance of a false alarm, seen from one of them: each channel, each family
/// (kind of region and weight) and each member of a family gets an equal share of what is above it.
class Multiplicity {
public:
    Multiplicity(const Functionals& functionals, Method method);
    [[nodiscard]] double of(RegionKind kind) const;
    /// The members of a kind's families, of all weights and channels together.
    [[nodiscard]] double tests_of(RegionKind kind) const;
    [[nodiscard]] std::vector<RegionKind> kinds() const;

private:
    std::map<RegionKind, double> members_;
    double weights_ = 0.0;
};

/// Asks the questions. Keeps references to golden and options.
class Judge {
public:
    Judge(const Golden& golden, Method method, const CompareOptions& options);

    /// Whether the method can use this functional: t tests compare means, and only of linear functionals
    /// do two estimators of one picture have the same.
    [[nodiscard]] bool looks_at(std::size_t functional) const;

    /// The smallest relative error that so many batches of the golden's own kind would show in this
    /// functional, with the stated power; NaN where that is not defined. For Method::ranks.
    [[nodiscard]] double detectable(std::size_t functional, std::size_t channel, double batches) const;

    /// Judges batches. For Method::welch there must be two at least, of candidate and golden.
    [[nodiscard]] Finding judge(const std::vector<Row>& rows, std::size_t functional,
                                std::size_t channel) const;

    /// Judges an estimate of the functional whose noise has this |skewness| / sqrt(batches).
    [[nodiscard]] Finding judge(const MeanEstimate& candidate, double skewed, std::size_t functional,
                                std::size_t channel) const;

private:
    [[nodiscard]] Finding blank(std::size_t functional, std::size_t channel) const;
    [[nodiscard]] double detectable_by_ranks(const Finding& finding,
                                             const std::vector<double>& reference, double count) const;
    [[nodiscard]] double level_of(const Finding& finding) const;
    void compare_means(Finding& finding, const MeanEstimate& candidate, const Moments& reference,
                       double skewed) const;
    /// Of what a functional of this mean adds up, for a relative tolerance.
    [[nodiscard]] double size_of(const Finding& finding, double mean) const;
    [[nodiscard]] Reach reach_of(const Finding& finding, const MeanEstimate& candidate,
                                 const MeanEstimate& expected, double skewed,
                                 double golden_skewed) const;
    void finish(Finding& finding, const MeanEstimate& candidate, const MeanEstimate& reference) const;

    const Golden& golden_;
    const Functionals& functionals_;
    Method method_;
    const CompareOptions& options_;
    Multiplicity multiplicity_;
    double brightness_ = 0.0; // the golden's mean, over pixels and channels
};

/// One functional of several batches, in its own units.
std::vector<double> values_of(const std::vector<Row>& rows, const Functionals& functionals,
                              std::size_t functional, std::size_t channel);

/// Upper bound of the chance that a right picture fails. `stages` are the batches of each; with one
/// stage only a conviction at once counts. All stages are compared with the same golden, whose own error
/// they share: the bound is an integral over that error, for means that are normally distributed as
/// those of a few dozen batches nearly are, summed over all functionals as if none knew of another.
double false_alarm_bound(const Functionals& functionals, Method method, std::uint64_t golden_batches,
                         const std::vector<std::uint64_t>& stages, const CompareOptions& options);

} // namespace golden
