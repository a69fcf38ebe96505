#pragma once

// The contacts of a scene (scenes/contacts.h), in the form that kernels read.

#include "cuda/scene/scene_arrays.h"

namespace fast {

/// Fills in what `arrays` says of contacts: coincident surfaces, clearances (with the normals that these
/// are measured along), and what the lights and the eye lie on,
/// or lie so near that a float cannot tell on which side. Its other parts must be there.
void add_contacts(SceneArrays& arrays, const scenes::Scene& scene);

} // namespace fast
