#pragma once

// The Pareto front of time and error: which configuration has the least error for a limit of time.

#include "trade/round.h"

#include <cstddef>
#include <vector>

namespace trade {

/// The error of a configuration as a function of time. After T seconds on the wall, of which the build
/// takes a part, its relMSE is
///     e(T) = cost / (T - build) + floor.
struct Curve {
    std::vector<double> costs; // relMSE times seconds per round, see trade::costs
    double build = 0.0;        // seconds
    double first = 0.0;        // seconds for one sample per pixel: e(T) exists from build + first on
    double floor = 0.0;        // the squared bias; 0 if there is none
};

/// The curve of a configuration; `floor` is Estimates::floor.
Curve curve_of(const std::vector<Round>& rounds, double floor);

/// A stretch of the front: this curve has the least error for limits from `from` to `to` seconds.
struct Segment {
    std::size_t curve;
    double from, to;
};

struct Front {
    std::vector<Segment> segments; // ascending in time, without gaps
    /// By curve: whether it is on the front, or at some limit of time not certainly worse than the best
    /// (the interval of the ratio of errors, formed within rounds, contains 1).
    std::vector<bool> member;
};

/// The front for limits from the shortest that any curve can keep to `longest` seconds.
Front front_of(const std::vector<Curve>& curves, double longest);

} // namespace trade
