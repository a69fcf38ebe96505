#pragma once

// Rays through a tree, against a search without a tree.

#include "extremes/trees/tree_builds.h"

#include "scenes/scene.h"

namespace extremes {

/// The number of rays, of `count` random ones, for which the closest hit in a tree over the triangles of
/// `scene` is not the one of a search through all triangles, bit for bit. The rays go through the unit
/// cube. The fast path rounds all coordinates to floats, as they are.
int wrong_rays(const AnyBuilder& builder, const scenes::Scene& scene, int count, Random& random);

} // namespace extremes
