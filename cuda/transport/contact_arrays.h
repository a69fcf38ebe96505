#pragma once

// The contacts of a scene (scenes/contacts.h), in the form that kernels read.

#include "cuda/transport/scene_arrays.h"

namespace gpu {

/// Fills in what `arrays` says of contacts: coincident surfaces, and what the lights and the eye lie on.
/// Its other parts must be there. Ends that are not on a surface, but nearer than a float can tell on
/// which side, are moved away from it to their side.
void add_contacts(SceneArrays& arrays, const scenes::Scene& scene);

} // namespace gpu
