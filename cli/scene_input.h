#pragma once

// What the subcommands that read a scene have in common: the scene, the size of the picture, file names.

#include "scenes/scene.h"

#include <string>

namespace cli {

/// In pixels.
struct Size {
    int width, height;
};

/// Reads "WxH". Throws std::invalid_argument.
Size parse_size(const std::string& text);

/// Throws std::invalid_argument unless the file name `path`, given to `option`, is empty or ends in
/// `ending` (lower case), in any case.
void expect_ending(const std::string& path, const std::string& option, const std::string& ending);

/// The scene in `file`, with a camera for certain, moved back to see the whole scene if `frame`. Tells
/// what a person should know about it on stderr, unless `quiet`. Throws scenes::SceneError or
/// std::invalid_argument.
scenes::Scene load_scene(const std::string& file, bool frame, bool quiet);

} // namespace cli
