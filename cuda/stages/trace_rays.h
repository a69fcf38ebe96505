#pragma once

// The two queries of stages for one ray.

#include "cuda/transport/scene_view.h"

namespace fast {

/// The closest hit, where `active`; elsewhere none.
template <Needs needs>
HD Hit closest_hits(const SceneView<needs>& scene, const Ray& ray, bool /*active*/)
{
    return intersect(scene.geometry, ray);
}

/// Whether the ray hits anything, where `active`.
template <Needs needs>
HD bool occluded_rays(const SceneView<needs>& scene, const Ray& ray, bool /*active*/)
{
    return occluded(scene.geometry, ray);
}

} // namespace fast
