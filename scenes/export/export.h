#pragma once

// A scene as files of other renderers. What a format cannot say is an error that names it, never a
// silent change of the picture; docs/export.md lists what each format can say.

#include "scenes/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace scenes::exports {

/// What a file of a renderer says beside the scene. Formats without an integrator or without a film
/// (glTF) do not use all of it.
struct Options {
    int width = 240; // of the picture, in pixels
    int height = 160;
    std::optional<int> max_edges; // of a path, the camera's edge counted; none: no limit
    std::uint64_t samples = 64;   // per pixel
};

struct File {
    std::string name; // without a folder
    std::string bytes;
};

struct Exported {
    /// The files to write, all in one folder: first those that the last one names, if any.
    std::vector<File> files;
    /// One line each: what a reader of the file does differently and its file cannot change.
    std::vector<std::string> notices;
};

} // namespace scenes::exports
