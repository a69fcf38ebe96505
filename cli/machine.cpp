#include "cli/machine.h"

#include <CLI/CLI.hpp>

namespace cli {

std::string command_line(const CLI::App& command)
{
    std::string line = "plumbline " + command.get_name();
    for (const CLI::Option* option : command.get_options()) {
        if (option->count() == 0) continue;
        if (!option->get_positional()) line += " " + option->get_name();
        if (option->get_expected_max() == 0) continue; // a flag
        for (const std::string& result : option->results()) line += " " + result;
    }
    return line;
}

} // namespace cli
