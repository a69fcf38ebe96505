#pragma once

// Moves the camera to where all of the scene is in view.

#include "scenes/scene.h"

namespace scenes {

/// Moves the eye to the line through the centre of the scene's bounding box along the viewing direction,
/// 1.5 box diagonals before the centre. The axes and the field of view stay as they are. Throws
/// SceneError if the scene has no camera or no geometry, or if the diagonal overflows.
void frame_camera(Scene& scene);

} // namespace scenes
