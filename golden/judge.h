#pragma once

// The test of one functional: batches of a candidate, or an estimate, against the golden.

#include "golden/candidate.h"
#include "golden/compare_options.h"
#include "golden/finding.h"
#include "golden/golden.h"
#include "golden/method.h"
#include "golden/multiplicity.h"
#include "golden/statistics.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace golden {

/// Tests functionals of candidates against one golden. Keeps references to golden and options.
class Judge {
public:
    Judge(const Golden& golden, Method method, const CompareOptions& options);

    /// Whether the method can test this functional. t tests compare means, and the means of two
    /// estimators agree for linear functionals only.
    [[nodiscard]] bool can_test(std::size_t functional) const;

    /// The smallest relative error that is found in this functional with the stated power, by a
    /// candidate of `batches` batches of the golden's estimator; NaN where that is not defined.
    /// Method::ranks.
    [[nodiscard]] double detectable(std::size_t functional, std::size_t channel, double batches) const;

    /// Tests batches. For Method::welch candidate and golden must have two at least.
    [[nodiscard]] Finding judge(const Candidate& candidate, std::size_t functional,
                                std::size_t channel) const;

    /// Tests an estimate of the functional, of one picture, a film of one batch. `skewed`: |skewness| /
    /// sqrt(batches) of its noise.
    [[nodiscard]] Finding judge(const MeanEstimate& candidate, double skewed, std::size_t functional,
                                std::size_t channel, const images::BatchMoments& picture) const;

    /// The errors that an estimate of the functional finds: `detectable`, and `reach` of the whole
    /// picture. Nothing is tested.
    [[nodiscard]] Finding compared(const MeanEstimate& candidate, std::size_t functional,
                                   std::size_t channel) const;

    /// The adjusted p-value of the same test, without ratio and detectable error, which take longer;
    /// none if it is not conclusive. `reference`: the moments of the golden's functional.
    [[nodiscard]] std::optional<double> adjusted_p(const MeanEstimate& candidate, double skewed,
                                                   const Moments& reference, std::size_t functional,
                                                   std::size_t channel) const;

private:
    [[nodiscard]] Finding blank(std::size_t functional, std::size_t channel) const;
    void judge_by_means(Finding& finding, const Candidate& candidate, const Moments& pictures,
                        const Moments& reference, double largest) const;
    [[nodiscard]] double detectable_by_ranks(const Finding& finding,
                                             const std::vector<double>& reference, double count) const;
    [[nodiscard]] double level_of(const Finding& finding) const;
    /// `largest_event`: as of largest_unseen_event in golden/rare_events.h.
    void compare_means(Finding& finding, const MeanEstimate& candidate, const Moments& reference,
                       double skewed, double pictures, double largest_event = 0.0) const;
    /// As least_p of golden/rare_events.h.
    [[nodiscard]] double least_p_of(const Finding& finding, const MeanEstimate& estimate,
                                    const MeanEstimate& expected, const images::BatchMoments& moments,
                                    double pictures) const;
    /// The size to which a relative tolerance refers, for a functional of this mean.
    [[nodiscard]] double size_of(const Finding& finding, double mean) const;
    [[nodiscard]] Reach reach_of(const Finding& finding, const MeanEstimate& candidate,
                                 const MeanEstimate& expected, double skewed, double golden_skewed,
                                 double pictures, bool golden_lacks_events) const;
    void finish(Finding& finding, const MeanEstimate& candidate, const MeanEstimate& reference) const;

    const Golden& golden_;
    const Functionals& functionals_;
    Method method_;
    const CompareOptions& options_;
    Multiplicity multiplicity_;
    double brightness_ = 0.0; // the golden's mean, over pixels and channels
};

} // namespace golden
