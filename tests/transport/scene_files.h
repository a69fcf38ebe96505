#pragma once

// The scenes in the repository, and those that are there only on some machines.

#include "scenes/read_scene.h"

#include <cstdlib>
#include <filesystem>
#include <string>

namespace tests {

/// A scene of this repository, by its name without ending.
inline scenes::Scene our_scene(const std::string& name)
{
    return scenes::read_scene(std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "scenes" / (name + ".dae"));
}

/// A file of the shared folder: beside the repository, or where PLUMBLINE_SHARED says. It may be absent:
/// a test that needs it skips then.
inline std::filesystem::path shared_file(const std::string& name)
{
    const char* folder = std::getenv("PLUMBLINE_SHARED");
    const std::filesystem::path shared =
        folder != nullptr ? std::filesystem::path(folder)
                          : std::filesystem::path(PLUMBLINE_SOURCE_DIR).parent_path() / "shared";
    return shared / name;
}

} // namespace tests
