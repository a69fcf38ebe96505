#pragma once

// The contacts of a scene (scenes/contacts.h), in the form that kernels read.

#include "cuda/scene/scene_arrays.h"

namespace fast {

/// Fills in the contacts of `arrays`: coincident surfaces, clearances (with the normals along which they
/// are measured), and the surfaces that the lights and the eye lie on, or lie so near that a float
/// cannot decide on which side. The other parts of `arrays` must be complete.
void add_contacts(SceneArrays& arrays, const scenes::Scene& scene);

} // namespace fast
