#pragma once

// Is this picture right? The entry points: a candidate is judged against a golden, with a known chance
// of a false alarm, and the result states which errors could have been found. docs/comparison.md
// explains each step.

#include "golden/candidate.h"
#include "golden/compare_options.h"
#include "golden/comparison.h"
#include "golden/golden.h"
#include "golden/method.h"
#include "images/exr.h"
#include "images/image.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

namespace golden {

/// Throws std::invalid_argument if the two cannot be compared by this method: different scene hashes,
/// for Method::ranks different batch sizes, integrators' parameters, or the golden's own seed. An entry
/// that is missing in either is not compared.
void check_comparable(const Golden& golden, const images::Metadata& candidate, Method method);

/// Judges by one stage. A suspicion makes INCONCLUSIVE, as no further stage can confirm it, unless its
/// p-value is below the certainty level: then FAIL. Method::ranks or Method::welch; the latter needs two
/// batches at least and throws std::invalid_argument for fewer.
Comparison compare(const Golden& golden, const Candidate& candidate, Method method,
                   const CompareOptions& options = {});

/// The smallest relative error of the whole picture that a candidate of `batches` batches of the
/// golden's estimator makes detectable, per channel, as Comparison::detectable; NaN for a black channel.
std::array<double, 3> detectable_error(const Golden& golden, std::uint64_t batches,
                                       const CompareOptions& options = {});

/// Renders `batches` batches into an empty candidate, with a seed of its own for each stage.
using RenderStage = std::function<void(std::size_t stage, std::uint64_t batches, Candidate& candidate)>;

/// Judges in stages: all suspicions of the first are tested again on fresh renders. FAIL takes one that
/// is rejected in every stage, or one below the certainty level.
Comparison compare(const Golden& golden, const RenderStage& render, Method method,
                   const CompareOptions& options = {});

/// Judges several independent pictures, each equally good, of an unknown estimator, by Method::welch as
/// above. If a few pixels are far brighter than the golden's and make it INCONCLUSIVE, the reason states
/// the verdict without them. Throws as Candidate::add_batch and compare.
Comparison compare_pictures(const Golden& golden, std::span<const images::Image> pictures,
                            const CompareOptions& options = {});

/// Judges a single picture, the mean of `samples` samples per pixel. Its noise is assumed to be that of
/// the golden's estimator, or the noise measured between neighbouring blocks of its pixels, whichever is
/// larger: see noise_ratio. Pixels far brighter than the golden's are treated as by
/// compare_pictures. The golden's metadata must have a batch_size. Throws std::invalid_argument as
/// Candidate::add_batch, for samples that are not positive, and for a picture that has the golden's own
/// noise, such as a copy.
Comparison compare_picture(const Golden& golden, const images::Image& picture, double samples,
                           const CompareOptions& options = {});

} // namespace golden
