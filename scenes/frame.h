#pragma once

// Moves the camera to where all of the scene is in view.

#include "scenes/scene.h"

namespace scenes {

/// Moves the eye to the line through the centre of the scene's bounding box along the viewing direction,
/// 1.5 box diagonals before the centre. The axes and the field of view stay as they are. Throws
/// SceneError if the scene has no camera or no geometry, or if the diagonal overflows.
void frame_camera(Scene& scene);

/// Gives a scene without a camera one that sees all of it: it looks along (-1, 2, -1), which shows the
/// front, the right and the top of a scene whose z axis points up, with z up in the picture and a field
/// of view of 45 degrees horizontally. Its eye is where frame_camera puts it. Adds a notice.
/// Throws SceneError if the scene has no geometry, or if the diagonal overflows.
void add_camera(Scene& scene);

} // namespace scenes
