#pragma once

#include <string>

namespace cli {

/// The word of a command line that a shell reads as `argument`.
inline std::string quoted(const std::string& argument)
{
    const bool plain =
        !argument.empty() && argument.find_first_of(" \t\n'\"\\$&;()<>|*?#~`![]") == std::string::npos;
    if (plain) return argument;
    std::string text = "'";
    for (const char c : argument) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

} // namespace cli
