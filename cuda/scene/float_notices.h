#pragma once

// Notices about what single precision cannot represent in a scene, for the user to read before a render.

#include "scenes/scene.h"

#include <string>
#include <vector>

namespace fast {

/// One line for each of these, if the scene has any:
///   - triangles that have an area in the scene and none as floats: no ray hits them;
///   - triangles and spheres that are so small for their distance from the centre of the scene that rays
///     which leave them begin at a distance larger than the surface (clearance.h), and may miss others;
///   - triangles of glass so close over another surface that a ray which leaves them begins beyond it;
///   - an eye or a light that is near a surface, but not on it, at a distance that floats cannot
///   resolve;
///   - an eye so far away, a field of view so narrow or so wide, an emitter so small, or an index of
///     refraction so large, so small or so near 1 that results may be wrong by 1% (docs/extremes.md has
///     the limits).
std::vector<std::string> float_notices(const scenes::Scene& scene);

} // namespace fast
