#pragma once

// The subcommand `check-tree`: its options, and the function that adds it (see command.h).

#include "check/trees/check_tree.h"
#include "cli/command.h"

#include <cstdint>
#include <optional>
#include <string>

namespace cli {

struct CheckTreeCommand {
    std::string primitives; // .npy or .json
    std::string tree;       // a folder, or .json
    bool loose = false;
    std::optional<std::int64_t> root;
    std::optional<std::size_t> max_depth;
    int morton = 0; // 30 or 63: the leaves must be in this order
    bool no_costs = false;
    bool json = false;
};

/// Adds the subcommand to `program`.
void add_check_tree_command(CLI::App& program, Work& work);

} // namespace cli
