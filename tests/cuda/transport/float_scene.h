#pragma once

// Scenes in which floats hold every number exactly, so that both wings render exactly the same scene.

#include "scenes/scene.h"

namespace fast_transport_test {

/// `scene` scaled by a power of two to a diagonal between 1 and 2, with the centre of its box at the
/// origin, and rounded to a grid of 2^-22 of its diagonal or somewhat coarser. Every number of it is a
/// float, except that for the cos_cutoff of a spot 1 - cos_cutoff is one. Differences of coordinates
/// are exact in single precision, and fast::scene_arrays does not move or scale this scene. Radiance
/// does not change.
scenes::Scene float_scene(scenes::Scene scene);

/// `x` rounded to the nearest float.
double nearest_float(double x);
scenes::Vec3 nearest_float(const scenes::Vec3& v);

} // namespace fast_transport_test
