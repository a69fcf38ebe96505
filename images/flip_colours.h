#pragma once

// The colour spaces of FLIP, and the differences of colours in them.

#include "images/image.h"

#include <glm/mat3x3.hpp>

#include <cmath>

namespace images::flip_colours {

// Linear RGB to XYZ, by columns [IEC 61966-2-1].
inline const glm::dmat3 xyz_of_rgb({0.4123908, 0.2126390, 0.0193308}, {0.3575843, 0.7151687, 0.1191948},
                                   {0.1804808, 0.0721923, 0.9505322});
inline const glm::dmat3 rgb_of_xyz = glm::inverse(xyz_of_rgb);
inline const Rgb white = xyz_of_rgb * Rgb(1.0);

/// Linearised CIELAB: (Yy, Cx, Cz) [Andersson et al. 2020, sec. 4.1].
inline Rgb opponent_of(const Rgb& rgb)
{
    const Rgb xyz = xyz_of_rgb * rgb / white;
    return {116.0 * xyz.y - 16.0, 500.0 * (xyz.x - xyz.y), 200.0 * (xyz.y - xyz.z)};
}

inline Rgb rgb_of_opponent(const Rgb& opponent)
{
    const double y = (opponent.x + 16.0) / 116.0;
    return rgb_of_xyz * (white * Rgb(opponent.y / 500.0 + y, y, y - opponent.z / 200.0));
}

/// CIELAB, its chroma scaled by lightness for the Hunt effect [Andersson et al. 2020, sec. 4.1].
inline Rgb hunt_lab_of(const Rgb& rgb)
{
    const Rgb xyz = xyz_of_rgb * rgb / white;
    const auto f = [](double t) {
        constexpr double delta = 6.0 / 29.0;
        return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
    };
    const double lightness = 116.0 * f(xyz.y) - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (f(xyz.x) - f(xyz.y)),
            0.01 * lightness * 200.0 * (f(xyz.y) - f(xyz.z))};
}

/// City-block in lightness, Euclidean in chroma [Abasi et al. 2020].
inline double hyab(const Rgb& a, const Rgb& b)
{
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

} // namespace images::flip_colours
