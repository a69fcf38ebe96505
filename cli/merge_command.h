#pragma once

// The subcommand `merge`: its options, and the function that adds it (see command.h).

#include "cli/command.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct MergeCommand {
    std::vector<std::string> parts;
    std::vector<std::string> outputs;
    std::uint64_t samples = 0; // that the whole has per pixel; 0: whatever the parts make
    bool finish = false;       // write no state
    bool check = false;        // look at the parts, and write nothing
    double exposure = 0.0;
    bool quiet = false;
};

/// Adds the subcommand to `program`.
void add_merge_command(CLI::App& program, Work& work);

} // namespace cli
