#include "extremes/point.h"

#include "scenes/short_number.h"

#include <algorithm>

namespace extremes {

bool Point::failed() const
{
    return std::ranges::any_of(failures, [](std::uint64_t count) { return count > 0; });
}

Point point_of(double parameter, const Tally& tally)
{
    Point point{parameter,           tally.cases(),   tally.errors(),
                tally.quantile(0.5), tally.largest(), {},
                tally.refusal(),     tally.notice(),  tally.cases() == 0 ? tally.left_out() : ""};
    for (std::size_t kind = 0; kind < failure_kinds; ++kind)
        point.failures.at(kind) = tally.failures(static_cast<Failure>(kind));
    return point;
}

std::optional<SafeRange> safe_range(const Axis& axis, std::span<const Point> points)
{
    const auto ordinary = std::ranges::find(points, axis.ordinary, &Point::parameter);
    if (ordinary == points.end() || !ordinary->safe()) return std::nullopt;
    auto first = ordinary;
    auto last = ordinary;
    while (first != points.begin() && (first - 1)->safe()) --first;
    while (last + 1 != points.end() && (last + 1)->safe()) ++last;
    return SafeRange{first->parameter, last->parameter};
}

std::optional<double> first_failure(const Axis& axis, std::span<const Point> points, Failure kind,
                                    bool above)
{
    std::optional<double> nearest;
    for (const Point& point : points) {
        const bool on_side = above ? point.parameter >= axis.ordinary : point.parameter <= axis.ordinary;
        if (!on_side || point.failures.at(static_cast<std::size_t>(kind)) == 0) continue;
        if (!nearest || !above) nearest = point.parameter; // below, the last one is the nearest
    }
    return nearest;
}

std::string contradiction(const Axis& axis, const Limit& limit, std::span<const Point> points)
{
    const auto [from, to] = std::minmax(axis.ordinary, limit.safe);
    for (const Point& point : points) {
        const std::string where = " at " + scenes::short_number(point.parameter);
        if (point.cases == 0) continue;
        if (point.parameter == limit.beyond &&
            point.failures.at(static_cast<std::size_t>(limit.failure)) == 0)
            return "no case fails" + where + ", beyond the limit: " + std::string(name(limit.failure));
        if (point.parameter < from || point.parameter > to) continue;
        for (std::size_t kind = 0; kind < failure_kinds; ++kind)
            if (point.failures.at(kind) > 0)
                return std::to_string(point.failures.at(kind)) + " of " + std::to_string(point.cases) +
                       " cases fail" + where + ": " + std::string(failure_names.at(kind));
        if (const double bound = limit.bound(point.parameter); !(point.largest <= bound))
            return "an error of " + scenes::short_number(point.largest) + " is above the bound of " +
                   scenes::short_number(bound) + where;
    }
    return "";
}

} // namespace extremes
