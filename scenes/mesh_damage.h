#pragma once

// Finds damage in mesh files (cut short or garbled) that Assimp does not detect, or that makes it crash.

#include <string>
#include <string_view>

namespace scenes {

/// A description of the damage in `bytes` as a PLY file; empty if the header is right and all numbers
/// that it announces are there. Source of the format: Turk, The PLY Polygon File Format, 1994.
std::string damage_of_ply(std::string_view bytes);

/// The same for an STL file: a text file must consist of complete facets between `solid` and `endsolid`,
/// and a binary file must have the length that follows from its number of triangles.
std::string damage_of_stl(std::string_view bytes);

/// The same for a GLB file: the lengths in its header and its chunks must agree with its own length
/// [Khronos 2021, glTF 2.0, sec. 4.4].
std::string damage_of_glb(std::string_view bytes);

} // namespace scenes
