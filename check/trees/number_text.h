#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace check {

/// The shortest text that gives `x` again: as a float if it is one, else as a double.
inline std::string number_text(double x)
{
    std::array<char, 32> text{};
    const auto as_float = static_cast<float>(x);
    const bool is_float = static_cast<double>(as_float) == x;
    const auto [end, error] = is_float ? std::to_chars(text.data(), text.data() + text.size(), as_float)
                                       : std::to_chars(text.data(), text.data() + text.size(), x);
    return {text.data(), end};
}

} // namespace check
