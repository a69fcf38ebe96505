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
/// for Method::ranks different batch sizes, integrators' parameters, or the golden's own seed. What a
/// candidate does not say about itself is not checked.
void check_comparable(const Golden& golden, const images::Metadata& candidate, Method method);

/// Judges by what there is: one stage. A suspicion that no further stage can confirm or clear makes
/// INCONCLUSIVE, unless its p-value is below the certainty level. Method::ranks or Method::welch; the
/// latter needs two batches at least and throws std::invalid_argument for fewer.
Comparison compare(const Golden& golden, const Candidate& candidate, Method method,
                   const CompareOptions& options = {});

/// What a candidate of so many batches of the golden's own kind would let see: the smallest relative
/// error of the whole picture, per channel, as Comparison::detectable; NaN for a channel that is black.
std::array<double, 3> detectable_error(const Golden& golden, std::uint64_t batches,
                                       const CompareOptions& options = {});

/// Renders `batches` batches into an empty candidate, with random numbers that no other stage used.
using RenderStage = std::function<void(std::size_t stage, std::uint64_t batches, Candidate& candidate)>;

/// Judges in stages: a suspicion of the first is tested again on fresh renders, and it takes all of them
/// to fail.
Comparison compare(const Golden& golden, const RenderStage& render, Method method,
                   const CompareOptions& options = {});

/// Judges several independent pictures, each equally good, of an unknown estimator, by Method::welch as
/// above. If what rules the result are a few pixels far brighter than the golden's, it says what the
/// verdict would be without them. Throws as Candidate::add_batch and compare.
Comparison compare_pictures(const Golden& golden, std::span<const images::Image> pictures,
                            const CompareOptions& options = {});

/// Judges a single picture, said to be the mean of `samples` samples per pixel. Its noise is taken to be
/// that of the golden's estimator, or what it shows between neighbouring pixels beyond the golden's own
/// noise, whichever is larger: see noise_ratio. Pixels far brighter than the golden's are treated as by
/// compare_pictures. The golden's metadata must have a batch_size. Throws std::invalid_argument as
/// Candidate::add_batch, for samples that are not positive, and for a picture that has the golden's own
/// noise, as a copy of it has.
Comparison compare_picture(const Golden& golden, const images::Image& picture, double samples,
                           const CompareOptions& options = {});

} // namespace golden
