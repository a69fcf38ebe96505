#pragma once

// Pictures of a tree, from the scene's camera. The scene must have one.

#include "images/image.h"
#include "ref/trees/geometry.h"

namespace cli {

/// The scene lit by a headlight, with the edges of all boxes at depth `level` of the tree (and of leaves
/// above that depth): full colour where they are visible, faint where a surface hides them.
images::Image draw_boxes(const ref::Geometry& geometry, int level, int width, int height);

/// The scene lit by a headlight, each primitive in the colour of its piece when the list of leaves is
/// cut into `pieces` (>= 1) of equal length.
images::Image draw_order(const ref::Geometry& geometry, std::size_t pieces, int width, int height);

/// Per pixel the number of boxes that the ray through its middle enters: black for none, then red,
/// yellow and, for `most` or more, white.
images::Image draw_visits(const ref::Geometry& geometry, double most, int width, int height);

} // namespace cli
