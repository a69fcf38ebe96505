#pragma once

// The sentences of a verdict's reason.

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

/// "about 5900 samples per pixel are needed instead of 1024", in pictures or batches where the number of
/// samples is not known; or the size of the golden that is needed, if its own noise hides such an error.
std::string say_shortfall(const Comparison& comparison);

/// "1.05 +- 0.06 times what its samples were assumed to have". Requires noise_ratio.
std::string say_noise(const Comparison& comparison);

/// "its own noise hides errors below 0.1%", and that more samples hardly help if this is nearly the
/// detectable error; empty for a black golden.
std::string say_golden_limit(const Comparison& comparison);

/// Sets the reason: the odd pixels, then `text`.
void give_reason(Comparison& comparison, const std::string& text);

/// The diagnosis, and other possible causes of a difference, for a picture that fails or is suspected:
/// sentences to append to the reason, each with a space before it, or nothing. `candidate` are the
/// picture's metadata, `mean` the picture.
std::string say_possible_causes(const Comparison& comparison, const Golden& golden,
                                const images::Metadata& candidate, const images::Image& mean);

} // namespace golden
