#pragma once

// Scenes for pbrt-v4.

#include "scenes/export/export.h"

namespace scenes::exports {

/// `scene`, which has a camera, as a file for pbrt-v4 called `file_name`. Throws SceneError for what
/// pbrt cannot say: a coloured mirror, coloured glass, a spot light that fades by a power of the cosine.
Exported to_pbrt(const Scene& scene, const Options& options, const std::string& file_name);

} // namespace scenes::exports
