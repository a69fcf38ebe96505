#pragma once

// A sample as a picture: both walks and the lines of sight of its strategies, in the scene.

#include "explain/sample.h"

#include <string>

namespace explain {

/// What a drawing contains besides the scene, the walks and the lines of sight.
enum class Paths {
    none,
    hidden // each known path whole, as a group of class "path" that is not displayed, for a page
};

/// An SVG document of three views: from the camera, from above, and from the side. The eye walk, the
/// light walk, and the lines between them: of strategies that contribute, and, dashed, of those that are
/// blocked.
std::string drawing(const ref::World& world, const Sample& sample, Paths paths = Paths::none);

} // namespace explain
