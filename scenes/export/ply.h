#pragma once

// Triangles as a PLY file.

#include "scenes/export/surfaces.h"

namespace scenes::exports {

/// The bytes of a binary PLY file with the coordinates as doubles: every bit is kept.
std::string ply_of(const Mesh& mesh);

} // namespace scenes::exports
