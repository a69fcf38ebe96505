#pragma once

// The boxes of a tree drawn over the scene that it holds.

#include "golden/image.h"
#include "ref/trees/geometry.h"

namespace cli {

/// The scene seen by its camera, lit by a headlight, with the edges of all boxes at depth `level` of the
/// tree (and of leaves above that depth): full colour where nothing hides them, faint where something
/// does. The scene must have a camera.
golden::Image draw_boxes(const ref::Geometry& geometry, int level, int width, int height);

} // namespace cli
