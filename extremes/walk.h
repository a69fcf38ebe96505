#pragma once

// Walks along an axis: every method at every value of the parameter.

#include "extremes/axis.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace extremes {

struct WalkOptions {
    int cases = 1000; // per point, at most Axis::most_cases; at least 1
    std::uint64_t seed = 1;
    unsigned threads = 1;
    std::function<bool()> stop = [] { return false; }; // called by one thread at a time
};

/// `options.cases` random cases of `method` at `parameter`. They depend on the seed, the axis and the
/// parameter alone: all methods get the same cases, and the number of threads changes nothing. None if
/// options.stop() returned true before all were done. What `method` throws is passed on.
std::optional<Tally> visit(const Axis& axis, const Method& method, double parameter,
                           const WalkOptions& options);

/// The parameters farthest from axis.ordinary on both sides, such that all values from axis.ordinary
/// to there are free of failures. `at(i)` is the tally at axis.values[i].
struct SafeRange {
    double from, to;
};
std::optional<SafeRange> safe_range(const Axis& axis,
                                    const std::function<const Tally&(std::size_t)>& at);

/// The value nearest to axis.ordinary on one side (below it or above it) at which `kind` occurs; none if
/// it occurs at no value on that side. The ordinary value itself belongs to both sides.
std::optional<double> first_failure(const Axis& axis, Failure kind, bool above,
                                    const std::function<const Tally&(std::size_t)>& at);

} // namespace extremes
