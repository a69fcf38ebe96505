#pragma once

// The levels and limits of a comparison.

#include <cstdint>
#include <vector>

namespace golden {

struct CompareOptions {
    /// Chance that the first stage of a right picture suspects a difference, all tests together.
    double suspicion_level = 0.05;
    /// The same where a fresh render can confirm or clear it: then the first stage only chooses what the
    /// next one tests, and a higher level finds more at the price of more renders.
    double screening_level = 0.2;
    /// Level of each later stage, which tests the suspected functionals, one-sided.
    double confirmation_level = 1e-7;
    double certainty_level = 1e-8; // of an adjusted p-value: below it, one stage is enough for FAIL
    double dark_level = 1e-9;      // of all pixels together: below it, a dark pixel is enough for FAIL
    /// PASS requires that a relative error of the whole picture of this size is detectable.
    double specification = 0.005;
    double power = 0.99;      // chance that a detectable error is suspected
    double confidence = 0.99; // of the intervals of ratios
    double rounding = 2e-6;   // relative difference that single precision explains
    double skewness = 0.15;   // largest |skewness| / sqrt(batches) for which a t test is conclusive
    std::vector<std::uint64_t> stages = {64, 256}; // batches of each stage
    /// Samples per pixel of each of several pictures. 0: not known; then they are taken for as many as
    /// in a batch of the golden (rare_events.h).
    double picture_samples = 0.0;
};

} // namespace golden
