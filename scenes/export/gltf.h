#pragma once

// Scenes as glTF 2.0.

#include "scenes/export/export.h"

namespace scenes::exports {

/// `scene`, which has a camera, as glTF 2.0: a JSON file called `file_name` and one with the numbers of
/// its meshes beside it (.bin); or both in one binary file if `file_name` ends in ".glb", in any case.
/// Throws SceneError for what glTF cannot say: spheres, spot lights, an environment, mirrors that
/// absorb, glass with a reflectance other than 1, and a scene so far from the origin that single
/// precision changes its shape.
Exported to_gltf(const Scene& scene, const Options& options, const std::string& file_name);

} // namespace scenes::exports
