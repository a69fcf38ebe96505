// Which files hold meshes, by their names.

#include "scenes/read_mesh.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace scenes {

bool is_mesh_file(const std::filesystem::path& path)
{
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array known = {".obj", ".ply", ".stl", ".gltf", ".glb"};
    return std::ranges::any_of(known, [&](const char* one) { return ending == one; });
}

} // namespace scenes
