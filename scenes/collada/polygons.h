#pragma once

// The polygons of a mesh: <triangles>, <polylist> and <polygons> all say which vertices form which
// polygon.

#include "scenes/collada/document.h"

#include <cstdint>
#include <vector>

namespace scenes::collada {

/// Polygons one after the other: polygon i has sizes[i] corners, the next ones of `corners`.
struct Polygons {
    std::vector<std::uint32_t> sizes;
    std::vector<std::uint32_t> corners; // vertex indices, each below the vertex count
};

/// The polygons of a <triangles>, <polylist> or <polygons> element, which draws on `vertex_count`
/// vertices through its <input semantic="VERTEX">; what the other inputs index (normals, texture
/// coordinates) is ignored. Fails if the counts and indices do not agree with one another.
Polygons read_polygons(const Element& element, std::uint64_t vertex_count);

/// The input of that semantic in a <mesh>'s <vertices> or in an element that read_polygons takes; fails
/// unless there is exactly one.
const Element& required_input(const Element& element, const char* semantic);

} // namespace scenes::collada
