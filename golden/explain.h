#pragma once

// Which of several mistakes explains a picture? Each mistake is given as what it adds to the light of a
// right picture, by a render that has noise of its own. docs/comparison.md, section 6, states how often
// a mistake is named that is not there.

#include "golden/compare_options.h"
#include "golden/golden.h"
#include "golden/region.h"
#include "images/image.h"

#include <array>
#include <functional>
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

/// Judges one picture of `samples` samples per pixel, or several independent ones, less what the mistake
/// adds. Throws as compare_picture and Candidate::add_batch.
Fit fit(const Golden& golden, const std::vector<images::Image>& pictures, double samples,
        const Explanation& explanation, const CompareOptions& options = {});

/// Renders more, and returns all explanations with less noise than before, in the same order and number;
/// none if there is no time for more.
using MoreExplanations = std::function<std::vector<Explanation>()>;

/// A sentence that names the mistake without which the pictures do not differ from the golden; empty if
/// there is none. It is named if an eighth of the difference of the whole picture would have been found,
/// or the specified error, and if all other explanations are rejected. Two or three that cannot be told
/// apart are named together. Calls `more` until it is certain.
std::string explain(const Golden& golden, const std::vector<images::Image>& pictures, double samples,
                    const MoreExplanations& more, const CompareOptions& options = {});

} // namespace golden
