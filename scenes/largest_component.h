#pragma once

#include "scenes/scene.h"

#include <algorithm>
#include <cmath>

namespace scenes {

/// The largest absolute value of the components of `v`.
inline double largest_component(const Vec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

} // namespace scenes
