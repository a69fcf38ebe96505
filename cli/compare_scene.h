#pragma once

// A scene file as the candidate of `plumbline compare`.

#include "cli/compare_candidate.h"
#include "golden/golden.h"

#include <string>

namespace cli {

/// Whether right batches of the two have the same distribution.
bool same_estimator(const images::Metadata& a, const images::Metadata& b);

/// Renders the scene in stages, with the golden's parameters except those of the options, and compares
/// it with the golden.
/// The first stage has options.samples per pixel, rounded up to whole batches, a later one 4 times as
/// many. Throws scenes::SceneError, std::invalid_argument, Interrupted.
JudgedCandidate judge_scene(const golden::Golden& golden, const std::string& file,
                            const CompareCommand& options);

} // namespace cli
