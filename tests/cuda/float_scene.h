#pragma once

// Scenes of which floats hold every number exactly, so that both wings see the very same one.

#include "scenes/scene.h"

namespace cuda_test {

/// `scene` on a grid of 2^-22 of its diagonal or somewhat coarser, with the centre of its box at the
/// origin, a diagonal between 1 and 2, by a power of two, and every number of it a float. Differences of
/// coordinates are exact in single precision; and where gpu::scene_arrays moves and scales a scene, it
/// leaves this one where it is. Radiance is what it was.
scenes::Scene float_scene(scenes::Scene scene);

} // namespace cuda_test
