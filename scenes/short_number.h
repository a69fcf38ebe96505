#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace scenes {

/// A number with three significant digits, for people: "0.25", "1e+30".
inline std::string short_number(double number)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", number);
    return text.data();
}

} // namespace scenes
