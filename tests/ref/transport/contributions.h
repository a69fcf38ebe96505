#pragma once

// Comparison of individual contributions, without statistics.

#include "ref/transport/world.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace transport_test {

/// The contributions of `count` samples of a picture of 24 x 16 pixels, one sample per pixel in turn.
inline std::vector<ref::Contribution>
contributions(const scenes::Scene& scene, ref::Integrator integrator, int max_edges, std::uint32_t count)
{
    constexpr int width = 24;
    constexpr int height = 16;
    const ref::World world(scene, width, height);
    std::vector<ref::Contribution> out;
    for (std::uint32_t i = 0; i < count; ++i)
        integrator(world, {.seed = 9, .max_edges = max_edges}, {9, i % (width * height), i}, out);
    return out;
}

/// The number of contributions that differ by more than `tolerance` (relative); all, if the lists
/// differ in length.
inline std::size_t different(const std::vector<ref::Contribution>& a,
                             const std::vector<ref::Contribution>& b, double tolerance)
{
    if (a.size() != b.size()) return std::max(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        bool same = a[i].pixel == b[i].pixel && a[i].s == b[i].s && a[i].t == b[i].t &&
                    std::abs(a[i].weight - b[i].weight) <= tolerance * a[i].weight;
        for (int channel = 0; channel < 3; ++channel)
            same = same && std::abs(a[i].value[channel] - b[i].value[channel]) <=
                               tolerance * a[i].value[channel];
        count += same ? 0 : 1;
    }
    return count;
}

} // namespace transport_test
