#pragma once

// What a person should know before a scene is rendered in single precision.

#include "scenes/scene.h"

#include <string>
#include <vector>

namespace fast {

/// A line for each kind of surface that floats do not hold: triangles that have area in the scene and
/// none as floats, so that no ray meets them; and triangles and spheres so small for their distance from
/// the centre of the scene that rays which leave them begin further off than the surface is large
/// (clearance.h), and may miss what they should meet; and triangles of glass so close over another one
/// that a ray which leaves them begins beyond it; and an eye or a light so close to a surface, but not
/// on it, that floats do not know how far. Empty for an ordinary scene.
std::vector<std::string> float_notices(const scenes::Scene& scene);

} // namespace fast
