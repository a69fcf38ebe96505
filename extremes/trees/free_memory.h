#pragma once

// The memory that a large case may take without the machine having to swap.

#include <fstream>
#include <limits>
#include <string>

namespace extremes {

/// The bytes that programs can still allocate: MemAvailable of Linux. Infinite where that is unknown.
inline double free_memory()
{
    std::ifstream file("/proc/meminfo");
    for (std::string word; file >> word;) {
        double kibibytes = 0;
        if (word == "MemAvailable:" && file >> kibibytes) return 1024 * kibibytes;
    }
    return std::numeric_limits<double>::infinity();
}

} // namespace extremes
