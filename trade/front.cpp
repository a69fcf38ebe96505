#include "trade/front.h"

#include "trade/estimates.h"
#include "trade/rounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trade {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int limits_of_time = 400; // on a logarithmic scale

/// In one round, or with the mean cost. Infinite where the time is too short for a sample.
double error_after(const Curve& curve, double cost, double seconds)
{
    if (seconds < curve.build + curve.first) return infinity;
    return cost / (seconds - curve.build) + curve.floor;
}

double mean_cost(const Curve& curve)
{
    return std::accumulate(curve.costs.begin(), curve.costs.end(), 0.0) /
           static_cast<double>(curve.costs.size());
}

/// Whether the error of `curve` is certainly larger than that of `best`.
bool is_worse(const Curve& curve, const Curve& best, double seconds)
{
    if (seconds < curve.build + curve.first) return true;
    std::vector<double> a;
    std::vector<double> b;
    for (std::size_t r = 0; r < std::min(curve.costs.size(), best.costs.size()); ++r) {
        a.push_back(error_after(curve, curve.costs[r], seconds));
        b.push_back(error_after(best, best.costs[r], seconds));
        if (b.back() == 0.0) return a.back() > 0.0; // no noise, no bias
        if (a.back() == 0.0) return false;
    }
    return a.size() >= 2 && ratio_of_rounds(a, b).low > 1.0;
}

} // namespace

Curve curve_of(const std::vector<Round>& rounds, double floor)
{
    Curve curve{costs(rounds), 0.0, 0.0, floor};
    for (const Round& round : rounds) {
        curve.build += round.build.wall / static_cast<double>(rounds.size());
        curve.first += round.render.wall / round.samples() / static_cast<double>(rounds.size());
    }
    return curve;
}

Front front_of(const std::vector<Curve>& curves, double longest)
{
    Front front{{}, std::vector<bool>(curves.size(), false)};
    if (curves.empty()) return front;
    double shortest = infinity;
    for (const Curve& curve : curves) shortest = std::min(shortest, curve.build + curve.first);
    shortest = std::max(shortest, 1e-9);
    longest = std::max(longest, shortest);
    std::vector<double> mean;
    for (const Curve& curve : curves) mean.push_back(mean_cost(curve));

    for (int i = 0; i <= limits_of_time; ++i) {
        const double seconds =
            i == 0 ? shortest : shortest * std::pow(longest / shortest, i / double{limits_of_time});
        std::size_t best = 0;
        for (std::size_t c = 1; c < curves.size(); ++c)
            if (error_after(curves[c], mean[c], seconds) <
                error_after(curves[best], mean[best], seconds))
                best = c;
        if (front.segments.empty() || front.segments.back().curve != best)
            front.segments.push_back({best, seconds, seconds});
        front.segments.back().to = seconds;
        if (front.segments.size() > 1) (front.segments.end() - 2)->to = front.segments.back().from;
        for (std::size_t c = 0; c < curves.size(); ++c)
            if (!front.member[c] && (c == best || !is_worse(curves[c], curves[best], seconds)))
                front.member[c] = true;
    }
    return front;
}

} // namespace trade
