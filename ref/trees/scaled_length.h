#pragma once

#include "scenes/largest_component.h"
#include "scenes/scene.h"

#include <glm/geometric.hpp>

namespace ref {

/// The length of `v`, also where the squares of its components overflow or underflow. This happens for
/// areas, whose squares are products of four lengths.
inline double scaled_length(const scenes::Vec3& v)
{
    const double largest = scenes::largest_component(v);
    return largest > 0.0 ? largest * glm::length(v / largest) : 0.0;
}

/// `v` scaled to unit length; `v` must not be 0.
inline scenes::Vec3 scaled_normalize(const scenes::Vec3& v)
{
    return glm::normalize(v / scenes::largest_component(v));
}

} // namespace ref
