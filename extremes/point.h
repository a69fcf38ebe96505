#pragma once

// What one method did at one value of the parameter, as numbers to keep.

#include "extremes/axis.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace extremes {

struct Point {
    double parameter = 0.0;
    std::uint64_t cases = 0;
    std::uint64_t errors = 0;                            // cases with an error
    double median = 0.0, largest = 0.0;                  // of the errors; 0 if there are none
    std::array<std::uint64_t, failure_kinds> failures{}; // counts by kind
    std::string refusal, notice;                         // the first of each; empty if there is none
    std::string not_walked;                              // why there are no cases; empty if there are

    [[nodiscard]] bool failed() const;
    /// Whether there are cases, and none failed.
    [[nodiscard]] bool safe() const { return cases > 0 && !failed(); }
};

Point point_of(double parameter, const Tally& tally);

/// A range of the parameter without failures, with axis.ordinary in it.
struct SafeRange {
    double from, to;
};

/// The largest such range that `points` show; they are in increasing order of the parameter. None if
/// there is a failure at the ordinary value, or no point there.
std::optional<SafeRange> safe_range(const Axis& axis, std::span<const Point> points);

/// The parameter nearest to axis.ordinary on one side (below it or above it) at which `kind` occurs;
/// none if it occurs at no point on that side. The ordinary value itself belongs to both sides.
std::optional<double> first_failure(const Axis& axis, std::span<const Point> points, Failure kind,
                                    bool above);

/// What contradicts `limit` in the points of its method, for people: a failure or an error above the
/// bound between axis.ordinary and limit.safe, or that the stated failure does not occur at
/// limit.beyond. Empty if nothing does. Points that were not walked say nothing.
std::string contradiction(const Axis& axis, const Limit& limit, std::span<const Point> points);

} // namespace extremes
