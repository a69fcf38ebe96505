#pragma once

// Vertex positions: a <source> with its array and the accessor that says how to step through it.

#include "scenes/collada/document.h"
#include "scenes/scene.h"

#include <vector>

namespace scenes::collada {

/// The points that a <source> holds: its accessor takes `count` of them from a <float_array>, point i
/// from the values at offset + i * stride on, where the <param>s named X, Y and Z say which value is
/// which coordinate. Every count is checked against the data before anything is allocated for it.
std::vector<Vec3> read_positions(const Document& document, const Element& source);

} // namespace scenes::collada
