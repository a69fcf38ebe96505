#pragma once

// The closest hit, found by testing every primitive. Queries with a tree must agree with it bit for
// bit.

#include "ref/trees/intersect_primitive.h"

namespace trees_test {

inline std::optional<ref::Hit> intersect_by_linear_search(const scenes::Scene& scene,
                                                          const ref::Ray& ray)
{
    const ref::ShearedRay sheared(ray);
    std::optional<ref::Hit> closest;
    for (std::uint32_t primitive = 0; primitive < scenes::primitive_count(scene); ++primitive) {
        const auto hit = ref::intersect_primitive(scene, ray, sheared, primitive);
        if (hit && (!closest || comes_before(*hit, *closest))) closest = hit;
    }
    return closest;
}

} // namespace trees_test
