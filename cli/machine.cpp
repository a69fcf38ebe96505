#include "cli/machine.h"

#include <CLI/CLI.hpp>

#include <array>
#include <ctime>
#include <fstream>

namespace cli {

std::string today()
{
    const std::time_t now = std::time(nullptr);
    std::tm broken_down{};
    localtime_r(&now, &broken_down);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d", &broken_down);
    return text.data();
}

std::string processor_name() // as Linux names it: proc(5), cpuinfo
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(": ") + 2);
    return "unknown processor";
}

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
