#pragma once

// Renders of the golden's scene with the mistakes of light transport that `compare --scene` looks for.

#include "cli/compare_command.h"
#include "golden/diagnosis.h"
#include "golden/golden.h"

#include <vector>

namespace cli {

/// The mistakes of `options.scene`, the golden's scene, to be tried in this order, each group with the
/// renders that it needs: paths of some lengths that are missing or too many, half a pixel aside, the
/// field of view along the other axis. `samples`: per pixel of the candidate, which the renders have as
/// well, but for large pictures; 0 if not known: the golden's. None if no scene was given. Throws
/// scenes::SceneError, or std::invalid_argument if it is not the golden's scene. The groups throw
/// Interrupted, and `golden` must outlive them.
std::vector<golden::MakeFaults> faults_of_scene(const golden::Golden& golden, double samples,
                                                const CompareCommand& options);

} // namespace cli
