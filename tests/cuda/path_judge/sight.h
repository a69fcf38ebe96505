#pragma once

// Whether the floats may be right about what sees what, where the reference says otherwise.

#include "tests/cuda/path_judge/followed_walk.h"

#include <optional>

namespace cuda_test {

/// A segment, or a ray to infinity, that is tested for anything in its way. The floats' may begin and
/// end elsewhere, within the slacks.
struct LineOfSight {
    ref::Vec3 from;
    double from_slack;
    ref::Vec3 to; // or the direction
    double to_slack;
    bool to_infinity = false;
    std::optional<std::uint32_t> start = {}, end = {}; // the primitives that it leaves and comes to
};

/// How far the floats may have moved an end that is no surface, the eye or a light: not at all, unless
/// it is on a surface or too near one for a float to tell on which side
/// (cuda/scene/contact_arrays.cpp).
double end_slack(const ref::World& world, const ref::Vec3& end);

/// Nothing, if rounding can explain that the floats say `seen` and the reference the opposite: throws
/// Undecided then, else Disagreement.
[[noreturn]] void explain_sight(const ref::World& world, const LineOfSight& line, bool seen);

} // namespace cuda_test
