#pragma once

// A scene that `plumbline compare` renders itself.

#include "cli/compare_candidate.h"
#include "golden/golden.h"

#include <string>

namespace cli {

/// Whether batches of the two are distributed alike if both are right.
bool same_estimator(const images::Metadata& a, const images::Metadata& b);

/// Renders the scene in stages as the golden was rendered, but for what the options say, and judges it.
/// The first stage has options.samples per pixel, rounded up to whole batches, a later one 4 times as
/// many. Throws scenes::SceneError, std::invalid_argument, Interrupted.
JudgedCandidate judge_scene(const golden::Golden& golden, const std::string& file,
                            const CompareCommand& options);

} // namespace cli
