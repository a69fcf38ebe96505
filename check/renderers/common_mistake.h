#pragma once

// The mistake of light transport that explains failing scenes, by renders of these scenes
// (check/mistakes/explanations.h).

#include "check/mistakes/explanations.h"
#include "check/renderers/check_renderer.h"

#include <functional>

namespace check {

struct MistakeSearch {
    unsigned threads = 1;
    std::function<bool()> stop; // asked often, from any thread; then what is known is kept
    /// As RendererOptions::mistakes_progress; may be empty.
    std::function<void(const SceneCheck&, double done, double total)> progress;
    ExplanationBudget budget = {}; // for one scene
};

/// Looks for the mistake among all usual ones in the failing scene in which it shows most: in which the
/// difference is largest in units of the smallest visible error; in the next one if it has no name
/// there. The other failing scenes are then explained by it, or not: there only this mistake is
/// rendered, or those that the first scene cannot tell apart, of which the others may exclude some. Sets
/// `check.mistake`, and the diagnoses of the scenes that it explains. Does nothing, in no time, if no
/// scene FAILs, or if the only one that does has a diagnosis. Goldens of another integrator than bdpt,
/// or with too many edges or pixels, are left out.
void find_common_mistake(RendererCheck& check, const MistakeSearch& search);

} // namespace check
