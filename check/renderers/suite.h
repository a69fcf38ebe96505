#pragma once

// The scenes of Plumbline that have a golden.

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace check {

/// A scene, its golden, and what it asks of a renderer.
struct SuiteScene {
    std::string name; // of both files, without their endings
    std::filesystem::path scene;
    std::filesystem::path golden;
    std::set<std::string> features; // by the names of features.h
    std::string hash;               // of the scene's file
};

/// The folder that holds scenes/ and golden/renders/: `named` if it is not empty, else the current one,
/// else the first above `program` (the file of this program), or share/plumbline of one above it, where
/// both are installed. Throws std::invalid_argument if there is
/// none.
std::filesystem::path find_suite(const std::string& named, const std::filesystem::path& program);

/// The scenes of that folder that have a golden, in the order of their names: those in `names` (all, if
/// it is empty) without those in `without`, which may name scenes and features. Throws
/// std::invalid_argument for an unknown name and if no scene is left; scenes::SceneError for a scene
/// that cannot be read.
std::vector<SuiteScene> chosen_scenes(const std::filesystem::path& suite,
                                      const std::vector<std::string>& names,
                                      const std::vector<std::string>& without);

} // namespace check
