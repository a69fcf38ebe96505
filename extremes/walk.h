#pragma once

// Walks along an axis: every method at every value of the parameter.

#include "extremes/axis.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

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

/// The same for several methods, a tally for each. Every thread runs them one after the other on the
/// same cases, as Axis::shared_truth needs.
std::optional<std::vector<Tally>> visit(const Axis& axis, std::span<const Method* const> methods,
                                        double parameter, const WalkOptions& options);

} // namespace extremes
