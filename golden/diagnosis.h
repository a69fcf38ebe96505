#pragma once

// What is wrong with a picture: the usual mistakes are undone, one after the other, and the
// picture is judged again.

#include "golden/comparison.h"
#include "golden/faults.h"
#include "golden/golden.h"
#include "images/image.h"

#include <functional>
#include <string>
#include <vector>

namespace golden {

/// Judges pictures as the comparison was made that is to be explained.
using JudgePictures = std::function<Comparison(const std::vector<images::Image>&)>;

/// A sentence that names a mistake of light transport, by renders of the golden's scene (explain.h);
/// empty if there is none.
using Explain = std::function<std::string()>;

/// Makes mistakes that take time to make, such as renders of the golden's scene (camera_faults.h).
using MakeFaults = std::function<std::vector<Fault>()>;

/// A sentence that names the mistake without which the pictures PASS: "Your picture is upside down: with
/// this undone, it PASSes." Empty if `comparison`, which judged these `pictures`, is neither FAIL nor
/// INCONCLUSIVE with a suspicion of p < 1e-6, or if none of the usual mistakes explains it (faults.h),
/// and no constant factor. A known factor is named if
/// dividing by exactly this factor makes the pictures PASS. `samples`: per pixel; 0 if not known.
/// `explain`: called after all of these but a factor without a name. `more`: called one after the other,
/// last of all, until a mistake explains the difference.
///
/// The undone picture must PASS, which requires that an error of the specified size would have been
/// found. So a wrong picture of another kind gets no sentence, unless the mistake hides below that size.
std::string diagnose(const Golden& golden, const Comparison& comparison,
                     const std::vector<images::Image>& pictures, double samples,
                     const JudgePictures& judge, const Explain& explain = {},
                     const std::vector<MakeFaults>& more = {});

} // namespace golden
