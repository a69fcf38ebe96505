#pragma once

// The test of one functional: batches of a candidate, or an estimate, against the golden.

#include "golden/compare_options.h"
#include "golden/finding.h"
#include "golden/golden.h"
#include "golden/method.h"
#include "golden/multiplicity.h"
#include "golden/statistics.h"

#include <cstddef>
#include <vector>

namespace golden {

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

} // namespace golden
