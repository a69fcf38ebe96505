#pragma once

// Reads COLLADA 1.4.1 files with the CMU462 technique profile. The head of read_scene.cpp lists the file
// that reads each part of the format. Elements that would change the picture and are not supported are
// errors; elements that cannot change it (an editor's data) are ignored.

#include "scenes/scene.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace scenes {

/// A file that cannot be rendered as it stands. what() is one line that names the place:
/// `file.dae:12: <light id="Sun">: unknown kind <laser>`.
class SceneError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The parts of a file that are read.
enum class Parts {
    all,
    /// The input of a tree: triangles and spheres, all of one grey material, and the camera. Lights
    /// (area lights too) and materials are not read, so errors in them are not reported, and a camera
    /// that cannot be read gives a notice.
    geometry
};

/// Reads the scene in the COLLADA file at `path`. Throws SceneError if the file cannot be opened or
/// read, or whenever parse_scene does.
Scene read_scene(const std::filesystem::path& path, Parts parts = Parts::all);

/// Reads the scene in `xml`, the bytes of a COLLADA file. `file_name` (a path is fine; the folder is
/// dropped) begins every error message and, without its ending, becomes Scene::name. Throws SceneError.
Scene parse_scene(std::string_view xml, const std::string& file_name, Parts parts = Parts::all);

} // namespace scenes
