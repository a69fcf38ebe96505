#pragma once

// Rays and hits. `t` is measured in multiples of the direction, which need not have unit length.

#include "cuda/trees/triangle.h"

#include <cstdint>

namespace fast {

/// The points origin + t * direction with 0 < t < t_max.
template <class F>
struct RayOf {
    Vec3Of<F> origin;
    F t_max;
    Vec3Of<F> direction;
};
using Ray = RayOf<float>;

/// The point where a ray hits a primitive; the primitive is no_primitive if there is no hit.
template <class F>
struct HitOf {
    F t;
    WordOf<F> primitive;
    F b1, b2; // weights of the second and third vertex; 0 on a sphere
};
using Hit = HitOf<float>;

/// Whether `a` is closer, or as close and of lower number: so the closest hit does not depend on the
/// tree.
HD inline bool comes_before(const Hit& a, const Hit& b)
{
    return a.t < b.t || (a.t == b.t && a.primitive < b.primitive);
}

} // namespace fast
