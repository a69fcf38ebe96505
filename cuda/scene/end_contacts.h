#pragma once

// The surfaces that the ends of paths lie on which are not surfaces themselves: the eye, point lights
// and spot lights (scenes/contacts.h).

#include "cuda/scene/scene_arrays.h"

namespace fast {

/// Fills in SceneArrays::contact_planes and contact_triangles, and for the eye and each light at a point
/// the ranges of those that it lies on, or lies so near that a float cannot decide on which side. After
/// add_clearances.
void add_end_contacts(SceneArrays& arrays, const scenes::Scene& scene);

} // namespace fast
