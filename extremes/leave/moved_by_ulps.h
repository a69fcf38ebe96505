#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace extremes {

/// `x` moved by units in the last place in proportion to `n`, or, near 0, by a fixed distance: with the
/// constants of [Waechter and Binder 2019, listing 6-1] for floats. For doubles the fixed distance is
/// smaller by the ratio of the formats' units in the last place, 2^29.
inline float moved_by_ulps(float x, float n)
{
    constexpr float near = 1.0f / 32.0f;
    if (std::abs(x) < near) return x + n / 65536.0f;
    const auto steps = static_cast<std::int32_t>(256.0f * n);
    return std::bit_cast<float>(std::bit_cast<std::int32_t>(x) + (x < 0 ? -steps : steps));
}
inline double moved_by_ulps(double x, double n)
{
    constexpr double near = 1.0 / 32.0;
    if (std::abs(x) < near) return x + n * 0x1p-45;
    const auto steps = static_cast<std::int64_t>(256.0 * n);
    return std::bit_cast<double>(std::bit_cast<std::int64_t>(x) + (x < 0 ? -steps : steps));
}

/// A point moved so along the unit vector `n`.
template <class Vec3>
Vec3 point_moved_by_ulps(const Vec3& point, const Vec3& n)
{
    return {moved_by_ulps(point.x, n.x), moved_by_ulps(point.y, n.y), moved_by_ulps(point.z, n.z)};
}

} // namespace extremes
