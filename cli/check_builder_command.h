#pragma once

// The subcommand `check-builder`: its options, and the function that adds it (see command.h).

#include "cli/command.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

struct CheckBuilderCommand {
    std::vector<std::string> command; // the builder, with {primitives} and {tree}
    std::vector<std::string> kinds;   // names of kinds of input; empty: all
    std::vector<std::string> skipped;
    std::string input; // a file of primitives: the only input
    std::string keep = "failing_input.npy";
    bool triangles = false;
    bool double_precision = false;
    bool loose = false;
    std::optional<std::size_t> max_depth;
    double timeout = 10.0;
    double budget = 300.0;
    std::size_t cases = 100;
    std::size_t largest = std::size_t{1} << 20;
    std::uint64_t seed = 1;
    bool json = false;
    bool quiet = false;
};

/// Adds the subcommand to `program`.
void add_check_builder_command(CLI::App& program, Work& work);

} // namespace cli
