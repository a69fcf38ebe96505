#pragma once

// The subcommand `explain-tree`: its options, and the function that adds it (see command.h).

#include "cli/command.h"

#include <cstdint>
#include <string>

namespace cli {

struct ExplainTreeCommand {
    std::string scene;
    std::uint32_t primitive = 0;
    std::string builder = "morton30";
    bool json = false;
    bool quiet = false;
};

/// Adds the subcommand to `program`.
void add_explain_tree_command(CLI::App& program, Work& work);

} // namespace cli
