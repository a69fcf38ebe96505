#pragma once

// Surfaces that coincide as floats or nearly do (scenes/contacts.h), and the clearances at which rays
// leave surfaces (cuda/trees/clearance.h), as arrays.

#include "cuda/scene/scene_arrays.h"

namespace fast {

/// The largest clearance of any surface, at the end of the longest segment, in units of the scene's
/// diagonal: 18 u for the rounding of the ray, the end and the surface (end_clearance), plus that of
/// clearance.h; for a sphere 30 u.
constexpr double largest_clearance = 30 * unit_roundoff + clearance_per_length;

/// Fills in SceneArrays::coincident and surface_contacts. Throws std::invalid_argument for more than
/// 2^32 - 1 pairs.
void add_coincident(SceneArrays& arrays, const scenes::Scene& scene);

/// Fills in the clearances of all surfaces, and the normals and edge margins of triangles. After
/// add_coincident.
void add_clearances(SceneArrays& arrays);

/// Whether a surface coincides with another one.
bool coincides(const SceneArrays& arrays, const Surface& surface);

/// The extent of the largest surface that coincides with this one, which must coincide with some.
float largest_coincident(const SceneArrays& arrays, const Surface& surface);

} // namespace fast
