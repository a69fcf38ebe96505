#pragma once

// The scenes in the repository, and those that exist only on some machines.

#include "scenes/read_scene.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace transport_test {

inline const std::filesystem::path our_folder = std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "scenes";

/// A scene of this repository, by its name without extension.
inline scenes::Scene our_scene(const std::string& name)
{
    return scenes::read_scene((our_folder / name).concat(".dae"));
}

/// The files of all of them, in the order of their names.
inline std::vector<std::filesystem::path> our_scene_files()
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(our_folder))
        if (entry.path().extension() == ".dae") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// Their names without extension, for our_scene.
inline std::vector<std::string> our_scene_names()
{
    std::vector<std::string> names;
    for (const std::filesystem::path& file : our_scene_files()) names.push_back(file.stem());
    return names;
}

/// A file of the shared folder: beside the repository, or in PLUMBLINE_SHARED. It may be absent; a
/// test that needs it is then skipped.
inline std::filesystem::path shared_file(const std::string& name)
{
    const char* folder = std::getenv("PLUMBLINE_SHARED");
    const std::filesystem::path shared =
        folder != nullptr ? std::filesystem::path(folder)
                          : std::filesystem::path(PLUMBLINE_SOURCE_DIR).parent_path() / "shared";
    return shared / name;
}

} // namespace transport_test
