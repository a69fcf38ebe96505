#pragma once

// Sets of boxes of all difficult kinds.

#include "ref/trees/aabb.h"
#include "tests/ref/trees/meshes.h"

#include <limits>
#include <string>
#include <vector>

namespace trees_test {

using ref::Aabb;

/// The distribution of the centroids of a set.
enum class Kind {
    uniform,
    clustered,
    duplicated,
    coincident,
    flat,
    collinear,
    huge,
    tiny,
    denormal,
    mixed
};

constexpr int kinds = 10;

inline std::string name(Kind kind)
{
    constexpr std::array<const char*, kinds> names = {
        "uniform",   "clustered", "duplicated", "coincident", "flat",
        "collinear", "huge",      "tiny",       "denormal",   "mixed"};
    return names[static_cast<std::size_t>(kind)];
}

/// `n` boxes; some have no volume, no area or no extent at all.
inline std::vector<Aabb> boxes(Kind kind, std::size_t n, Random& random)
{
    std::vector<Aabb> result;
    const Vec3 fixed = random.in_cube();
    for (std::size_t i = 0; i < n; ++i) {
        Vec3 center = random.in_cube();
        Vec3 half = random.magnitude(-6, -0.5) * (random.in_cube() + 1.0);
        if (random.below(4) == 0) half[static_cast<int>(random.below(3))] = 0;
        if (random.below(8) == 0) half = Vec3(0);
        double scale = 1;
        switch (kind) {
        case Kind::uniform:
            break;
        case Kind::clustered:
            center = Vec3(static_cast<double>(random.below(3))) + 1e-9 * center;
            break;
        case Kind::duplicated:
            if (i > 0 && random.below(2) == 0) {
                result.push_back(result[random.below(i)]);
                continue;
            }
            break;
        case Kind::coincident:
            center = fixed;
            break;
        case Kind::flat:
            center.y = fixed.y;
            break;
        case Kind::collinear:
            center = fixed * center.x;
            break;
        case Kind::huge:
            scale = 1e30;
            break;
        case Kind::tiny:
            scale = 1e-30;
            break;
        case Kind::denormal:
            scale = 100 * std::numeric_limits<double>::denorm_min();
            break;
        case Kind::mixed:
            scale = random.magnitude(-30, 30);
            break;
        }
        result.push_back({scale * (center - half), scale * (center + half)});
    }
    return result;
}

} // namespace trees_test
