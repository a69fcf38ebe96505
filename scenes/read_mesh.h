#pragma once

// Reads the triangles of files that hold meshes: OBJ, PLY, STL, glTF 2 and its binary form GLB. The
// library Assimp reads them; a build without it reads none (read_mesh_none.cpp).

#include "scenes/scene.h"

#include <filesystem>
#include <string>

namespace scenes {

/// The ending of the name of `path` with its dot, in lower case.
std::string lower_case_ending(const std::filesystem::path& path);

/// Whether the name of `path` ends in .obj, .ply, .stl, .gltf or .glb, in any case.
bool is_mesh_file(const std::filesystem::path& path);

/// The triangles of the file at `path`, with the transforms of its nodes, in the order of nodes (parents
/// first) and of the file, all of one grey material. No triangle is joined with another or dropped,
/// those without area included; polygons are cut as those of COLLADA files are
/// (scenes/polygons/triangulate.h), and lines and points are left out with a notice. Coordinates are
/// rounded to floats, as Assimp keeps them. There are no lights and no camera.
///
/// Throws SceneError, with the file's name, if the file cannot be read, is damaged or cut short (which
/// an OBJ file does not show if it ends with a line), holds a coordinate that is NaN or infinite, no
/// triangle at all, or more than 2^24; and in a build without Assimp always.
Scene read_mesh(const std::filesystem::path& path);

} // namespace scenes
