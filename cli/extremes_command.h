#pragma once

// The subcommand `extremes`: its options, and the function that adds it (see command.h).

#include "cli/command.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct ExtremesCommand {
    std::vector<std::string> axes;    // names or numbers; empty: all
    std::vector<std::string> methods; // names; empty: all
    bool list = false;
    int cases = 1000;
    std::uint64_t seed = 1;
    unsigned threads = 0; // 0: as many as the processor has
    std::string output;   // .json
    std::string report;   // .html
    bool resume = false;
    std::vector<std::string> from; // .json: earlier results, to be shown without a walk
    bool json = false;
    bool markdown = false;
    bool quiet = false;
};

/// Adds the options to `command`, which sets `options` when it is parsed.
void add_extremes_options(CLI::App& command, ExtremesCommand& options);

/// Throws std::invalid_argument or images::ImageError for options that exclude each other, and for files
/// that cannot be written.
void check(const ExtremesCommand& options);

/// Adds the subcommand to `program`.
void add_extremes_command(CLI::App& program, Work& work);

} // namespace cli
