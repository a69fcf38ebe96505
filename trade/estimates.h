#pragma once

// From the rounds of a configuration to numbers with intervals: time, bias and noise apart, and
// efficiency.

#include "trade/estimate.h"
#include "trade/round.h"
#include "trade/truth.h"

#include <string>
#include <vector>

namespace trade {

struct Levels {
    double confidence = 0.95; // of all intervals
    /// The chance that any of `configurations` unbiased ones is called biased: they share it.
    double false_mark = 0.005;
    std::size_t configurations = 1;
    double power = 0.99;    // chance that a detectable bias is found
    double rounding = 2e-6; // relative difference that single precision explains
    double skewness = 0.15; // largest |skewness| / sqrt(batches) for which a t test is conclusive
};

enum class BiasVerdict { none_found, biased, undecided };
std::string describe(BiasVerdict verdict); // "none found", "biased", "undecided"

/// Relative errors of the brightness of the picture and of its parts. The error of the truth is part
/// of every interval.
struct Bias {
    BiasVerdict verdict = BiasVerdict::undecided;
    Estimate whole; // of the picture: 0.01 is one percent too bright
    Estimate worst; // of the stratum with the strongest evidence, for all strata at once
    std::string worst_region;
    /// The chance that an unbiased study has evidence as strong as this one's anywhere: the smallest
    /// p-value of the conclusive tests, times the number of regions and configurations, at most 1.
    double p = 1.0;
    /// The relative error of the whole that is found with probability `power`, even if the noise is as
    /// much larger than measured as one time in twenty.
    double detectable = 0.0;
    std::string reason; // one sentence
};

struct Times {
    Estimate wall, cpu; // seconds
};

struct Estimates {
    Times build;
    Times render; // per sample per pixel
    Bias bias;
    Estimate noise;        // relMSE of one sample per pixel, by noise alone
    Estimate bias_squared; // the part of the relMSE that no number of samples removes
    Estimate relmse_1s;    // noise after one second of rendering, on the wall
    Estimate efficiency;   // 1 / (relMSE s), of the noise, on the wall
    /// Few samples contribute most of the noise: its interval, and those that contain it, may be too
    /// narrow.
    bool skewed = false;
    /// The bias as part of the relMSE, for curves of error against time: bias_squared of a biased
    /// configuration, else 0.
    double floor = 0.0;
};

/// Throws std::invalid_argument for fewer than two rounds.
Estimates estimate(const std::vector<Round>& rounds, const Truth& truth, const Levels& levels = {});

/// By round: seconds on the wall times relMSE, which for noise does not depend on the number of
/// samples. Its inverse is the efficiency.
std::vector<double> costs(const std::vector<Round>& rounds);

/// The time that `a` needs for the noise of `b`, as a multiple of b's time; formed within rounds. Only
/// the rounds that both have are used. Not stated for fewer than two, and where either has no noise.
Estimate time_to_equal_noise(const std::vector<Round>& a, const std::vector<Round>& b,
                             double confidence = 0.95);

/// The samples per second of `a` as a multiple of those of `b`, in the same way.
Estimate speed(const std::vector<Round>& a, const std::vector<Round>& b);

/// The samples per pixel from which `a`, which takes longer to build and less per sample, is done
/// before `b` [Fieller 1954, for the interval]. Not stated unless both differences are certain: then one
/// of the two is done first whatever their number, or neither is known to be.
Estimate samples_from_which_it_pays(const std::vector<Round>& a, const std::vector<Round>& b);

} // namespace trade
