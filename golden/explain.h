#pragma once

// Which of several mistakes explains a picture? Each mistake is given as what it adds to the light of a
// right picture, by a render that has noise of its own. docs/comparison.md, section 6, states how often
// a mistake is named that is not there.

#include "golden/fit.h"

#include <functional>
#include <string>
#include <vector>

namespace golden {

/// Renders more, and returns all explanations with less noise than before, in the same order and number;
/// none if there is no time for more.
using MoreExplanations = std::function<std::vector<Explanation>()>;

/// A mistake that explains pictures.
struct FoundMistake {
    std::string sentence;           // empty if there is none
    std::vector<std::string> named; // Explanation::is of it, or of all that cannot be told from it
    bool fitted = false;            // as Explanation::fitted
};

/// The mistake without which the pictures do not differ from the golden. It is found if an eighth of the
/// difference of the whole picture would have been found, or the specified error, and if all other
/// explanations are rejected. Two or three that cannot be told apart are named together. Calls `more`
/// until it is certain.
FoundMistake find_mistake(const Golden& golden, const std::vector<images::Image>& pictures,
                          double samples, const MoreExplanations& more,
                          const CompareOptions& options = {});

/// The sentence of find_mistake alone.
std::string explain(const Golden& golden, const std::vector<images::Image>& pictures, double samples,
                    const MoreExplanations& more, const CompareOptions& options = {});

} // namespace golden
