// Roulette that is not compensated: a walk survives a bounce with probability q, and its light is not
// divided by q. Strategy (s, t) needs t - 2 bounces of the eye walk, after z_1 ... z_{t-2}, and s - 2 of
// the light walk. Of those from number `first` on, each multiplies the light by q.

#include "check/mistakes/path_mistakes.h"

#include <algorithm>
#include <array>
#include <variant>

namespace check {

namespace {

struct Estimator {
    const char* name; // ends a sentence
    Weights weights;
    bool finds_all; // every path that the scene has
};

constexpr std::array<Estimator, 3> estimators = {
    Estimator{"(path tracing, hits and next events weighted)", path_tracing, false},
    Estimator{"(path tracing by next events)", next_event_first, false},
    Estimator{"(both walks of bidirectional path tracing)", bidirectional, true}};

/// The bounces from number `first` on, of a walk of `vertices` vertices whose last needs no bounce.
int decisions_of(std::size_t vertices, int first)
{
    return std::max(0, static_cast<int>(vertices) - 2 - (first - 1));
}

/// The largest component of what the surface reflects or transmits.
double albedo_of(const scenes::Material& material)
{
    struct {
        double operator()(const scenes::Lambertian& m) const { return ref::max_component(m.albedo); }
        double operator()(const scenes::Mirror& m) const { return ref::max_component(m.reflectance); }
        double operator()(const scenes::Glass& m) const
        {
            return std::max(ref::max_component(m.reflectance), ref::max_component(m.transmittance));
        }
        double operator()(const scenes::Emission& /*m*/) const { return 0.0; }
    } albedo;
    return std::visit(albedo, material);
}

/// The share of the light that survives with the albedo at each bounce from number `first` on.
double kept_by_albedo(const FinishedPath& path, std::size_t s, int first)
{
    const std::size_t k = path.edges();
    const std::size_t t = k + 1 - s;
    const auto albedo = [&](std::size_t i) {
        return albedo_of(ref::material_at(path.world, *path.x[i]));
    };
    double kept = 1.0;
    for (auto j = static_cast<std::size_t>(first); j + 2 <= t; ++j) kept *= albedo(k - j);
    for (auto j = static_cast<std::size_t>(first); j + 2 <= s; ++j) kept *= albedo(j);
    return kept;
}

/// Light that takes `count` decisions of roulette from bounce `first` on.
PathFactor taking(Weights weights, int first, int count)
{
    return [=](const FinishedPath& path) {
        double sum = 0.0;
        if (static_cast<int>(path.edges()) < first + count) return sum; // too short
        for (std::size_t s = 0; s <= path.edges(); ++s)
            if (decisions_of(path.edges() + 1 - s, first) + decisions_of(s, first) == count)
                sum += weights(path, s);
        return sum;
    };
}

} // namespace

void add_roulette(Mistakes& mistakes, int longest)
{
    const std::size_t not_found = mistakes.add_part(
        up_to(longest, [](const FinishedPath& path) { return 1.0 - found_by_path_tracing(path); }));
    // The longest eye walk ends by a hit: longest + 1 vertices.
    for (int first = 1; first <= longest - 1; ++first)
        for (const auto& [name, weights, finds_all] : estimators) {
            const std::string from = "from bounce " + std::to_string(first) + " on " + name;
            mistakes.add("one in which a walk survives roulette with the albedo of the surface " + from +
                             ", and its light is not divided by it",
                         up_to(longest, [weights = weights, first](const FinishedPath& path) {
                             double sum = -1.0;
                             for (std::size_t s = 0; s <= path.edges(); ++s) {
                                 const double weight = weights(path, s);
                                 if (weight > 0.0) sum += weight * kept_by_albedo(path, s, first);
                             }
                             return sum;
                         }));
            RouletteMistake roulette{from, {}, {}};
            if (!finds_all) roulette.adds.push_back({not_found, -1.0});
            for (int count = 1; count <= longest - first; ++count)
                roulette.decisions.push_back(
                    {mistakes.add_part(up_to(longest, taking(weights, first, count))), count});
            mistakes.roulettes.push_back(std::move(roulette));
        }
}

} // namespace check
