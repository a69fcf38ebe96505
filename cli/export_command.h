#pragma once

#include "cli/command.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

/// The options of `plumbline export`, as they are given on the command line.
struct ExportCommand {
    std::string scene;
    std::vector<std::string> outputs;
    std::string size = "240x160";
    std::uint64_t samples = 64;
    int max_edges = 0; // 0: not given
    bool frame = false;
    bool json = false;
    bool quiet = false;
};

/// Adds the subcommand `export` to `program`.
void add_export_command(CLI::App& program, Work& work);

} // namespace cli
