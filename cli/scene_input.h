#pragma once

// Input of the subcommands that read a scene: the scene, the size of the picture, file names.

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

/// `file` as messages name it: "-", which is standard input, is "<stdin>".
std::string shown_name(const std::string& file);

/// The scene in the COLLADA file `file`, or in standard input for "-" (its name is then "stdin"). It
/// always has a camera: its own, moved back until the whole scene is visible if `frame`, or else that of
/// scenes::add_camera. Prints notices to stderr, unless `quiet`. Throws
/// scenes::SceneError or std::invalid_argument.
scenes::Scene load_scene(const std::string& file, bool frame, bool quiet);

/// The same, with the coordinates and intensities of the file: not placed near the origin.
scenes::Scene load_scene_as_written(const std::string& file, bool frame, bool quiet);

/// The same for a tree, with triangles and spheres only: no lights and no materials are read
/// (scenes::Parts::geometry). The file may also be one of the formats of scenes::read_mesh.
scenes::Scene load_triangles(const std::string& file, bool frame, bool quiet);

} // namespace cli
