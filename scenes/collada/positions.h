#pragma once

// Vertex positions: a <source> with its array, and the accessor that gives offset and stride.

#include "scenes/collada/document.h"
#include "scenes/scene.h"

#include <vector>

namespace scenes::collada {

/// The points in a <source>. Its accessor takes `count` points from a <float_array>; point i begins at
/// the value at offset + i * stride. The <param>s named X, Y and Z give the place of each coordinate.
/// Every count is checked against the data before memory is allocated for it.
std::vector<Vec3> read_positions(const Document& document, const Element& source);

} // namespace scenes::collada
