#pragma once

// Whether rounding explains that the fast path and the reference disagree about visibility.

#include "tests/cuda/path_judge/followed_walk.h"

#include <optional>

namespace path_judge_test {

/// A segment, or a ray to infinity, that is tested for visibility. That of the fast path may begin and
/// end elsewhere, within the slacks.
struct LineOfSight {
    ref::Vec3 from;
    double from_slack;
    ref::Vec3 to; // or the direction
    double to_slack;
    bool to_infinity = false;
    std::optional<std::uint32_t> start = {}, end = {}; // the primitives at its ends
};

/// A bound on the distance by which the fast path may have moved an end that is not on a surface (the
/// eye or a light): 0, unless the end is on a surface or too near one for a float to decide the side
/// (cuda/scene/end_contacts.cpp).
double end_slack(const ref::World& world, const ref::Vec3& end);

/// The fast path has the visibility `seen`, and the reference the opposite. Throws Undecided if
/// rounding can explain this, and Disagreement otherwise.
[[noreturn]] void explain_sight(const ref::World& world, const LineOfSight& line, bool seen);

} // namespace path_judge_test
