#pragma once

// What the cases of leaving surfaces are made of: directions and turns.

#include "extremes/exact.h"
#include "extremes/random.h"
#include "scenes/scene.h"

#include <array>

namespace extremes {

/// Three orthonormal axes in a random orientation, up to rounding.
struct Turn {
    scenes::Vec3 x, y, z;
    [[nodiscard]] scenes::Vec3 operator()(const scenes::Vec3& v) const
    {
        return v.x * x + v.y * y + v.z * z;
    }
};
Turn random_turn(Random& random);

/// The unit vector from `a` to `b`, up to rounding: also where the difference of doubles would overflow
/// or its square underflow. The points must differ.
scenes::Vec3 direction_between(const scenes::Vec3& a, const scenes::Vec3& b);

/// Weights of N points: none below `margin`, sum 1. N margin must be less than 1.
template <std::size_t N>
std::array<double, N> random_weights(Random& random, double margin)
{
    // Uniform on the simplex: the gaps between sorted uniform numbers are as those of exponentials.
    std::array<double, N> weights{};
    double sum = 0.0;
    for (double& weight : weights) sum += weight = -std::log(1.0 - random.uniform());
    for (double& weight : weights)
        weight = margin + (1.0 - static_cast<double>(N) * margin) * weight / sum;
    return weights;
}

/// |cosine| between the normal of a triangle about one unit large and a unit direction.
double cosine_to_normal(const std::array<scenes::Vec3, 3>& triangle, const scenes::Vec3& direction);

/// The point of a triangle with these weights.
inline scenes::Vec3 weighted(const std::array<scenes::Vec3, 3>& v, const std::array<double, 3>& w)
{
    return w[0] * v[0] + w[1] * v[1] + w[2] * v[2];
}

} // namespace extremes
