#pragma once

// Files of meshes that are cut short or garbled in a way that Assimp does not notice, or does not
// survive.

#include <string>
#include <string_view>

namespace scenes {

/// What is wrong with `bytes` as a PLY file; empty if its header is right and all the numbers that it
/// promises are there. Source of the format: Turk, The PLY Polygon File Format, 1994.
std::string damage_of_ply(std::string_view bytes);

/// The same for an STL file: a text must be whole facets between `solid` and `endsolid`, and a binary
/// file must be as long as its number of triangles says.
std::string damage_of_stl(std::string_view bytes);

/// The same for a GLB file: the lengths that its header and its chunks state must fit its own [Khronos
/// 2021, glTF 2.0, sec. 4.4].
std::string damage_of_glb(std::string_view bytes);

} // namespace scenes
