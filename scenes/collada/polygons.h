#pragma once

// The polygons of a mesh: the vertices listed by <triangles>, <polylist> and <polygons>.

#include "scenes/collada/document.h"

#include "scenes/polygons/triangulate.h"

#include <cstdint>

namespace scenes::collada {

/// The polygons of a <triangles>, <polylist> or <polygons> element, which refers to `vertex_count`
/// vertices through its <input semantic="VERTEX">. The indices of the other inputs (normals, texture
/// coordinates) are ignored. A <ph> of <polygons> is a polygon with holes. Fails if the counts and
/// indices do not agree with one another.
polygons::Polygons read_polygons(const Element& element, std::uint64_t vertex_count);

/// The input of that semantic in a <mesh>'s <vertices> or in an element that read_polygons takes; fails
/// unless there is exactly one.
const Element& required_input(const Element& element, const char* semantic);

} // namespace scenes::collada
