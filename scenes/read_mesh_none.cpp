// Replaces read_mesh.cpp in a build without Assimp.

#include "scenes/read_mesh.h"

#include "scenes/read_scene.h"

namespace scenes {

Scene read_mesh(const std::filesystem::path& path)
{
    throw SceneError(path.filename().string() + ": " + path.extension().string() +
                     " files are read by the library Assimp, and this build is without it");
}

} // namespace scenes
