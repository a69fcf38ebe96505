#pragma once

// Reads the triangles of mesh files: OBJ, PLY, STL, glTF 2 and its binary form GLB. The library Assimp
// reads them; a build without Assimp reads none of them (read_mesh_none.cpp).

#include "scenes/scene.h"

#include <filesystem>
#include <string>

namespace scenes {

/// The extension of the file name in `path`, with its dot, in lower case.
std::string lower_case_ending(const std::filesystem::path& path);

/// Whether the name of `path` ends in .obj, .ply, .stl, .gltf or .glb, in any case.
bool is_mesh_file(const std::filesystem::path& path);

/// The triangles of the file at `path`, with the transforms of its nodes, in the order of nodes (parents
/// first) and of the file, all of one grey material. Triangles are neither joined nor dropped, also
/// those without area. Polygons are cut into triangles as in COLLADA files
/// (scenes/polygons/triangulate.h). Lines and points are left out with a notice. Coordinates are rounded
/// to floats, as in Assimp. The scene has no lights and no camera.
///
/// Throws SceneError, with the file's name, if the file cannot be read, is damaged or cut short (this is
/// not detected in an OBJ file that ends with a complete line), holds a coordinate that is NaN or
/// infinite, no triangle at all, or more than 2^24 triangles. In a build without Assimp it always
/// throws.
Scene read_mesh(const std::filesystem::path& path);

} // namespace scenes
