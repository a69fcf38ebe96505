#include "tests/ref/transport/chi_squared.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace transport_test {

std::vector<double> integrate_cells(const Density& density, const Grid& grid, int steps)
{
    std::vector<double> cells;
    const double du = 1.0 / (grid.rows * steps);
    const double dv = 1.0 / (grid.columns * steps);
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            double sum = 0.0;
            for (int i = 0; i < steps; ++i)
                for (int k = 0; k < steps; ++k)
                    sum += density({(row * steps + i + 0.5) * du, (column * steps + k + 0.5) * dv});
            cells.push_back(sum * du * dv);
        }
    return cells;
}

void expect_samples_follow_density(const Sampler& sample, const Density& density, const Grid& grid,
                                   int steps, std::uint32_t count)
{
    std::vector<double> expected = integrate_cells(density, grid, steps);
    const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
    expected.push_back(std::max(0.0, 1.0 - total)); // the probability of no sample

    std::vector<double> observed(expected.size(), 0.0);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto point =
            sample(ref::uniforms({.seed = 17, .pixel = 0, .sample = i}, ref::Event::camera));
        std::size_t cell = observed.size() - 1;
        if (point) {
            const int row = std::clamp(static_cast<int>(point->x * grid.rows), 0, grid.rows - 1);
            const int column =
                std::clamp(static_cast<int>(point->y * grid.columns), 0, grid.columns - 1);
            cell = static_cast<std::size_t>(row * grid.columns + column);
        }
        observed[cell] += 1.0;
    }

    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return expected[a] < expected[b]; });
    double statistic = 0.0;
    double pooled_expected = 0.0;
    double pooled_observed = 0.0;
    double observed_at_zero = 0.0;
    int pools = 0;
    for (const std::size_t cell : order) {
        if (expected[cell] == 0.0) observed_at_zero += observed[cell];
        pooled_expected += expected[cell] * count;
        pooled_observed += observed[cell];
        if (pooled_expected < 20.0 && cell != order.back()) continue;
        statistic +=
            (pooled_observed - pooled_expected) * (pooled_observed - pooled_expected) / pooled_expected;
        ++pools;
        pooled_expected = pooled_observed = 0.0;
    }
    // The midpoints of a cell may miss a corner of the density's support, but not more.
    EXPECT_LE(observed_at_zero, 20.0) << "samples where the density is zero";
    ASSERT_GT(pools, 1);
    const boost::math::chi_squared distribution(pools - 1);
    const double p = boost::math::cdf(boost::math::complement(distribution, statistic));
    EXPECT_GT(p, 1e-6) << "chi-squared " << statistic << " on " << pools << " cells";
}

void expect_directions_follow_density(
    const std::function<std::optional<glm::dvec3>(const ref::Uniforms&)>& sample,
    const std::function<double(const glm::dvec3&)>& pdf_solid_angle, const Grid& grid, int steps)
{
    constexpr double two_pi = 2.0 * std::numbers::pi;
    const auto to_square = [&](const glm::dvec3& w) {
        const double phi = std::atan2(w.y, w.x);
        return glm::dvec2((w.z + 1.0) / 2.0, (phi < 0.0 ? phi + two_pi : phi) / two_pi);
    };
    const auto to_direction = [&](const glm::dvec2& p) {
        const double z = 2.0 * p.x - 1.0;
        const double r = std::sqrt(1.0 - z * z);
        return glm::dvec3(r * std::cos(two_pi * p.y), r * std::sin(two_pi * p.y), z);
    };
    expect_samples_follow_density(
        [&](const ref::Uniforms& u) -> std::optional<glm::dvec2> {
            const auto w = sample(u);
            if (!w) return std::nullopt;
            return to_square(*w);
        },
        [&](const glm::dvec2& p) { return 2.0 * two_pi * pdf_solid_angle(to_direction(p)); }, grid,
        steps);
}

} // namespace transport_test
