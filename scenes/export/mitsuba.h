#pragma once

// Scenes for Mitsuba 3: an XML file, and a PLY file for the triangles of each material.

#include "scenes/export/export.h"

namespace scenes::exports {

/// `scene`, which has a camera, for Mitsuba 3. The XML file is called `file_name`, and the others are
/// named after it. Throws SceneError for what Mitsuba cannot say: a spot light that fades within its
/// cone.
Exported to_mitsuba(const Scene& scene, const Options& options, const std::string& file_name);

} // namespace scenes::exports
