#pragma once

// One picture by somebody else's renderer, or the reason why there is none.

#include "images/image.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace check {

/// What a renderer is asked for; the values of its command's placeholders.
struct PictureTask {
    std::filesystem::path scene;
    int width, height;
    std::uint64_t samples; // per pixel
    std::uint64_t seed;
    std::string max_edges;     // of the longest path, the camera's edge counted; or "unlimited"
    std::filesystem::path out; // .exr or .pfm
};

/// What came of it.
struct PictureAttempt {
    std::optional<images::Image> picture; // of the right size, all values finite
    /// Without a picture: "killed by signal 11 (Segmentation fault)", "wrote no picture", ...; empty if
    /// it was stopped.
    std::string failure;
    std::string last_lines; // of the renderer's output, without control characters
    double seconds = 0.0;
};

/// The words of the command for this task: {scene}, {width}, {height}, {samples}, {seed}, {max_edges}
/// and {out} replaced. Throws std::invalid_argument for another placeholder.
std::vector<std::string> words_for(const std::vector<std::string>& command, const PictureTask& task);

/// The picture in the file `path`, of this size. Throws images::ImageError if it cannot be read, has
/// another size or values that are NaN or infinite.
images::Image read_candidate(const std::filesystem::path& path, int width, int height);

/// Runs the command for at most `limit` seconds and reads the picture that it wrote. A file that was at
/// its place before is removed first. If `stop` returns true, the renderer is killed, and there is
/// neither picture nor failure. Throws std::runtime_error if the program cannot be started, and
/// std::invalid_argument as words_for.
PictureAttempt render_picture(const std::vector<std::string>& command, const PictureTask& task,
                              double limit, const std::function<bool()>& stop);

} // namespace check
