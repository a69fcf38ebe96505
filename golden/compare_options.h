#pragma once

// The levels and limits of a comparison.

#include <cstdint>
#include <vector>

namespace golden {

struct CompareOptions {
    double accuse = 0.05;         // chance that a right picture's first stage finds something to confirm
    double confirm = 1e-7;        // level of each later stage, at which one suspicion alone is tested
    double convict = 1e-8;        // level at which one stage is enough for FAIL
    double dark = 1e-9;           // level at which pixels that are too dark are enough for FAIL
    double specification = 0.005; // relative error of the whole picture that must be detectable to pass
    double power = 0.99;          // with this probability
    double confidence = 0.99;     // of the intervals of ratios
    double rounding = 2e-6;       // relative difference that is put down to single precision
    double skewness = 0.15;       // |skewness| / sqrt(batches) up to which a t test is believed
    std::vector<std::uint64_t> stages = {64, 256}; // batches of each
};

} // namespace golden
