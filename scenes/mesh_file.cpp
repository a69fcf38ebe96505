// Recognises mesh files by their names.

#include "scenes/read_mesh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace scenes {

std::string lower_case_ending(const std::filesystem::path& path)
{
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

bool is_mesh_file(const std::filesystem::path& path)
{
    constexpr std::array known = {".obj", ".ply", ".stl", ".gltf", ".glb"};
    return std::ranges::find(known, lower_case_ending(path)) != known.end();
}

} // namespace scenes
