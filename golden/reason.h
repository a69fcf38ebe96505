#pragma once

// The sentences that give a verdict's reason.

#include "golden/comparison.h"
#include "golden/golden.h"
#include "images/exr.h"
#include "images/image.h"

#include <string>

namespace golden {

/// A number or a fraction in percent with a few digits.
std::string say(double number, int digits);
std::string say_percent(double fraction);

/// "green of tile ... is 0.98 times the golden's (0.97 to 0.99), p = 1e-7"
std::string say_suspicion(const Comparison& comparison);

/// "about 5900 samples per pixel are needed instead of 1024", in pictures or batches where samples are
/// not known; or, if the golden's own noise hides such an error, how large a golden is needed.
std::string say_shortfall(const Comparison& comparison);

/// "1.05 +- 0.06 times what its samples were assumed to have"; for a comparison with a noise_ratio.
std::string say_noise(const Comparison& comparison);

/// "errors below 0.1% are hidden by the golden's own noise", and that more samples hardly help if that
/// is nearly what is detectable; nothing for a golden that is black.
std::string say_golden_limit(const Comparison& comparison);

/// Sets the reason: `text` after what is odd about single pixels.
void give_reason(Comparison& comparison, const std::string& text);

/// What may be the cause that a picture differs, for one that fails or is suspected: sentences to add to
/// the reason, each with a space before it, or nothing. `candidate` is what it says about its making,
/// `mean` the picture itself.
std::string say_possible_causes(const Comparison& comparison, const Golden& golden,
                                const images::Metadata& candidate, const images::Image& mean);

} // namespace golden
