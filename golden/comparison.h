#pragma once

// The result of a comparison, as data: the verdict, its reason, and all that they follow from.

#include "golden/finding.h"
#include "golden/method.h"
#include "golden/odd_pixels.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace golden {

enum class Verdict { pass, fail, inconclusive };
std::string describe(Verdict verdict); // "PASS", "FAIL", "INCONCLUSIVE"

/// The result of one stage.
struct Stage {
    std::uint64_t batches;
    double
        p; // first stage: the smallest adjusted p; later: the smallest one-sided p of what is suspected
    double level; // a suspicion stands if p < level
};

/// The batches that make an error of the specified size detectable.
struct Shortfall {
    /// Of the candidate (pictures, with Method::welch), with the golden as it is; infinite if the
    /// golden's own noise hides such an error.
    double candidate;
    double golden; // of a golden, its pilot included, if that is what limits
};

struct Comparison {
    Verdict verdict = Verdict::inconclusive;
    std::string reason;    // one or two sentences
    std::string diagnosis; // what is wrong with the picture (diagnosis.h); empty if that is not known
    Method method = Method::ranks;
    double p = 1.0; // the smallest adjusted p of the first stage
    std::vector<Finding> findings;
    std::optional<std::size_t>
        suspicion; // index into `findings`: the smallest adjusted p, significant or not; if further
                   // stages confirm some, the one with the smallest p in the last of these stages
    std::vector<Stage> stages;
    /// Smallest detectable relative error of the whole picture, per channel, at the first stage; NaN for
    /// a channel in which the golden is black.
    std::array<double, 3> detectable{};
    /// The same for a candidate without noise: smaller errors are hidden by the golden's own noise.
    std::array<double, 3> golden_limit{};
    std::optional<Shortfall> shortfall; // if `detectable` is larger than the specification
    std::vector<OddPixels> odd;         // of the candidate's pixels
    /// Index into `findings`: the stratum in which the smallest detectable error is largest.
    std::optional<std::size_t> least_sensitive_stratum;
    double false_alarm = 0.0; // upper bound of the chance that a right picture FAILs
    double coverage = 1.0;    // share of the findings that are conclusive
    /// Method::picture: measured over assumed variance of the picture's own noise, without its odd
    /// pixels, in the channel where the ratio is largest; and the standard error of this ratio.
    std::optional<double> noise_ratio, noise_error;
    std::uint64_t golden_batches = 0; // after its pilot
    double candidate_batches = 0.0;   // of its first stage; pictures, with Method::welch
    double batch_size = 0.0;          // samples per pixel in a batch of the golden; 0 if not known
};

/// The finding of the whole picture in this channel with plain weights: its ratio is that of the means.
const Finding& whole_picture(const Comparison& comparison, std::size_t channel);

/// z of the fine tiles in one channel with matched weights, row by row; NaN if inconclusive.
struct TileMap {
    int columns = 0, rows = 0;
    std::vector<double> z;
};
TileMap tile_map(const Comparison& comparison, std::size_t channel);

} // namespace golden
