#pragma once

// A picture with a mistake undone, against the golden. The mistake is known by a render, whose noise
// counts.

#include "golden/compare_options.h"
#include "golden/golden.h"
#include "golden/judge.h"
#include "golden/pixel_noise.h"
#include "golden/region.h"
#include "golden/statistics.h"
#include "images/image.h"

#include <array>
#include <string>
#include <vector>

namespace golden {

/// A mistake, and what it adds to a right picture. `adds` may be negative.
struct Explanation {
    std::string is;      // completes "Your picture is ..."
    images::Image adds;  // per pixel, the mean over batches of a render
    images::Image error; // its standard error
    double batches;      // at least 2
    /// A parameter of it was chosen to fit the pictures: it is named only if no other fits.
    bool fitted = false;
};

/// The pictures, with a mistake undone, against the golden.
struct Fit {
    double p = 1.0; // the smallest adjusted p-value; the noise of the explanation counts
    /// The smallest relative error of the whole picture that would have been found; infinite if none.
    /// Only if p is not tiny: else the tests end with the first difference.
    double detectable = 0.0;
    /// Of a single picture: the variance of its whole, per channel, as the scatter of the pixels shows
    /// it. What is left of a mistake scatters as well.
    std::array<double, channel_count> scatter{};
};

/// Pictures, to which explanations are fitted. Keeps references to all that it is made of.
class Fitting {
public:
    /// One picture of `samples` samples per pixel, or several independent ones.
    Fitting(const Golden& golden, const std::vector<images::Image>& pictures, double samples,
            const CompareOptions& options);

    /// Judges the pictures less what the mistake adds. Throws as Functionals::evaluate.
    [[nodiscard]] Fit fit(const Explanation& explanation) const;

private:
    /// A functional of the candidate, and |skewness| / sqrt(n) of its noise.
    struct Estimate {
        MeanEstimate value;
        double skewed;
        double scatter; // Fit::scatter
    };
    [[nodiscard]] Estimate estimated(const images::Image& undone, const std::vector<Row>& rows,
                                     const Explanation& explanation, std::size_t functional,
                                     std::size_t channel) const;
    [[nodiscard]] Estimate of_picture(const images::Image& undone, double value, double extra,
                                      std::size_t functional, std::size_t channel) const;

    const Golden& golden_;
    const std::vector<images::Image>& pictures_;
    double batches_; // of a single picture
    bool single_;
    Judge judge_;
    std::vector<Moments> references_; // per functional, then channel
    std::vector<PixelNoise> pixels_;  // the same, of several pictures
};

} // namespace golden
