#pragma once

// Numbers as text that reads back as the same number.

#include "scenes/scene.h"

#include <glm/trigonometric.hpp>

#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace scenes::exports {

/// The shortest decimal text that reads back as exactly `value`; "0" for -0.
inline std::string exact(double value)
{
    if (value == 0.0) return "0";
    std::array<char, 32> text{};
    char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

/// The same for three numbers, with `separator` between them.
inline std::string exact(const Vec3& v, std::string_view separator)
{
    return exact(v.x).append(separator).append(exact(v.y)).append(separator).append(exact(v.z));
}

/// The angle in degrees, as the shortest text for which holds(radians); as exactly as possible if it
/// holds for none.
template <class Holds>
std::string degrees(double radians, const Holds& holds)
{
    const double value = glm::degrees(radians);
    for (int digits = 1; digits <= 17; ++digits) {
        std::array<char, 40> text{};
        std::snprintf(text.data(), text.size(), "%.*g", digits, value);
        const double read = std::strtod(text.data(), nullptr);
        if (holds(glm::radians(read))) return exact(read);
    }
    return exact(value);
}

/// The angle in degrees, as the shortest text that reads back as the same number of radians.
inline std::string degrees(double radians)
{
    return degrees(radians, [&](double read) { return read == radians; });
}

/// The half angle of the cone of a spot light, in degrees.
inline std::string cone_degrees(const SpotLight& spot)
{
    return degrees(glm::acos(spot.cos_cutoff),
                   [&](double read) { return glm::cos(read) == spot.cos_cutoff; });
}

} // namespace scenes::exports
