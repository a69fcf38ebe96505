#pragma once

// Renders of the golden's scene with the mistakes that `compare --scene` looks for.

#include "cli/compare_command.h"
#include "golden/diagnosis.h"
#include "golden/golden.h"

#include <vector>

namespace cli {

/// Looks for mistakes with renders of `options.scene`, the golden's scene.
struct SceneMistakes {
    golden::Explain explain;              // mistakes of light transport (check/mistakes)
    std::vector<golden::MakeFaults> more; // half a pixel aside; the field of view along the other axis
};

/// For `pictures` of `samples` samples per pixel each (0 if not known: several). No functions if no
/// scene was given. Throws scenes::SceneError, or std::invalid_argument if it is not the golden's scene.
/// The functions throw Interrupted; `golden`, `pictures` and `options` must outlive them.
SceneMistakes mistakes_of_scene(const golden::Golden& golden, const std::vector<images::Image>& pictures,
                                double samples, const CompareCommand& options);

} // namespace cli
