#pragma once

// Scenes of which floats hold every number exactly, so that both wings see the very same one.

#include "scenes/scene.h"

namespace cuda_test {

/// `scene` on a grid of 2^-22 of its diagonal or somewhat coarser, with the centre of its box at the
/// origin, a diagonal between 1 and 2, by a power of two, and every number of it a float; of a
/// spot's cos_cutoff, 1 - cos_cutoff is. Differences of
/// coordinates are exact in single precision; and where fast::scene_arrays moves and scales a scene, it
/// leaves this one where it is. Radiance is what it was.
scenes::Scene float_scene(scenes::Scene scene);

/// `x` rounded to the nearest float. GCC 12.2 drops the rounding from double to float and back wherever
/// it vectorises it (p[0] = (float)p[0]; p[1] = (float)p[1]; at -O2): a call that is not inlined keeps
/// it.
double nearest_float(double x);
scenes::Vec3 nearest_float(const scenes::Vec3& v);

} // namespace cuda_test
