#pragma once

// Tests whether a sampling routine follows its density: a histogram against integrals, cell by cell
// [Pearson 1900], as in the tests of other renderers.

#include "ref/transport/random.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace transport_test {

/// A grid over the unit square; samples in no cell are counted in an extra one.
struct Grid {
    int rows, columns;
};
inline constexpr Grid coarse{10, 20};
inline constexpr Grid fine{50, 100};

/// The point of the unit square for the numbers u; nullopt where the routine gives no sample.
using Sampler = std::function<std::optional<glm::dvec2>(const ref::Uniforms& u)>;
/// The density at a point of the unit square; its integral is at most 1.
using Density = std::function<double(const glm::dvec2& point)>;

/// The integral of the density over each cell, by the midpoint rule with `steps`^2 points per cell.
std::vector<double> integrate_cells(const Density& density, const Grid& grid, int steps);

/// Pearson's test at alpha = 1e-6, on cells pooled to at least 20 expected samples. The seed is fixed,
/// so the result is always the same; the level tells how unlikely a failure of a correct routine is.
void expect_samples_follow_density(const Sampler& sample, const Density& density, const Grid& grid,
                                   int steps, std::uint32_t count = 400'000);

/// The same for directions: the unit square is (z, phi) in equal-area coordinates, so that a density
/// per solid angle is 4 pi times smaller than one on the square.
void expect_directions_follow_density(
    const std::function<std::optional<glm::dvec3>(const ref::Uniforms&)>& sample,
    const std::function<double(const glm::dvec3&)>& pdf_solid_angle, const Grid& grid, int steps);

} // namespace transport_test
