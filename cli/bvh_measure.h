#pragma once

// What a tree builder costs, and what its trees are worth.

#include "cli/builders.h"
#include "cli/scene_input.h"
#include "scenes/scene.h"

#include <nlohmann/json_fwd.hpp>

namespace cli {

/// Builds the tree `repeats` times, and sends a ray through the middle of each pixel of a picture of
/// this size and one diffusely from where it hits: the entry of `plumbline bvh --json` for this builder.
/// Rays of each kind are traced until the mean time is known to 2% (standard error of the mean of at
/// least five repetitions) or a second has passed; "camera_relative_standard_error" and
/// "diffuse_relative_standard_error" say what was reached (null if there were no rays). The scene must
/// have a camera. CPU time, one thread.
nlohmann::json measure_builder(const scenes::Scene& scene, const NamedBuilder& named, const Size& size,
                               int repeats);

} // namespace cli
