#pragma once

// The subcommand `trade`: its options, and the function that adds it (see command.h).

#include "cli/command.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct TradeCommand {
    std::string scene; // empty with `from`
    std::string size = "64x64";
    bool frame = false;
    double seconds = 60.0;
    std::size_t rounds = 8;
    std::uint64_t seed = 1;
    std::vector<std::string> base;  // "integrator=bdpt"
    std::vector<std::string> knobs; // "threads", "max-edges=2,4"; empty: the usual ones
    bool needs = false;             // measure what the scene does not require
    std::string output;             // .json
    std::string report;             // .html
    bool resume = false;
    std::string from;  // .json: earlier results, to be shown without a measurement
    std::string truth; // a golden; empty: the cached one
    double truth_seconds = 60.0;
    std::string cache; // folder
    bool json = false;
    bool quiet = false;
    bool size_given = false;
};

/// Adds the options to `command`, which sets `options` when it is parsed, all but size_given.
void add_trade_options(CLI::App& command, TradeCommand& options);

/// Throws std::invalid_argument or images::ImageError for options that exclude each other, and for files
/// that cannot be written.
void check(const TradeCommand& options);

/// Adds the subcommand to `program`.
void add_trade_command(CLI::App& program, Work& work);

} // namespace cli
