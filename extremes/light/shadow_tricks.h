#pragma once

// The usual tricks by which shadow rays avoid both of their ends.

#include "extremes/axis.h"
#include "extremes/light/under_emitter.h"

namespace extremes {

/// Methods on the axis of an emitter's size, in both formats. The radiance of the floor is the mean of
/// `samples` textbook estimates, albedo / pi L A cos cos' / d^2, of points of the emitter; each counts
/// if its shadow ray meets nothing. Coordinates are used as they stand in the file, rounded to the
/// format. The tricks:
///   fixed, relative  the ray starts and ends this distance, or share of its length, from its ends;
///   ulps             both ends are moved along their normals by units in the last place;
///   exclude          the triangles at both ends are not tested.
std::vector<Method> shadow_tricks(int samples);

} // namespace extremes
