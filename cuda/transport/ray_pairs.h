#pragma once

// Two rays, one after the other: to a surface, and onward from there. This is the part of a walk that
// rounding can break; plumbline extremes compares it with exact arithmetic.

#include "cuda/transport/contacts.h"

namespace fast {

/// A ray to a surface, and the direction (of any length) in which the light goes on from there, to
/// either side.
struct RayPair {
    Ray first;
    Vec3 onward;
};

/// The surfaces that both rays see. Without a first hit there is no second one.
struct PairOfHits {
    Hit first, second; // primitive: no_primitive if nothing is hit
};

/// Kernel over pairs: the steps of a walk that find the next surface (subpath.h).
template <Needs needs>
struct TraceRayPairs {
    SceneView<needs> scene;
    std::span<const RayPair> pairs;
    std::span<PairOfHits> hits;

    HD void operator()(std::uint32_t i) const
    {
        const auto& [first, onward] = pairs[i];
        PairOfHits found{seen(first), {0, no_primitive, 0, 0}};
        if (found.first.primitive != no_primitive) {
            const SurfacePoint point = surface_point<needs, float>(scene, first, found.first);
            found.second =
                seen({leave_surface(point, onward), std::numeric_limits<float>::infinity(), onward});
        }
        hits[i] = found;
    }

private:
    [[nodiscard]] HD Hit seen(const Ray& ray) const
    {
        const Hit hit = intersect(scene.geometry, ray);
        return hit.primitive == no_primitive ? hit
                                             : first_of_coincident<needs, float>(scene, ray, hit, true);
    }
};

} // namespace fast
