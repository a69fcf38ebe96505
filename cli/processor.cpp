#include "cli/processor.h"

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

} // namespace cli
