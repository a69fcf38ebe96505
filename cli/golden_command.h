#pragma once

// The subcommand `golden`: its options, and the function that adds it (see command.h).

#include "cli/command.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace cli {

struct GoldenCommand {
    std::vector<std::string> scenes;
    bool all = false; // every .dae in `scene_folder`
    std::string scene_folder = "scenes";
    std::string folder = "golden/renders";
    std::string size = "64x64";
    std::uint64_t samples = 1024;
    std::uint32_t batch_size = 4;
    std::uint64_t pilot_batches = 32;
    int max_edges = 6;
    unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    double watch = 60.0;    // seconds between writes of a golden in the making
    std::string batches;    // "4..8": a part of a golden, these batches alone
    std::string output;     // of the part
    std::string pilot_file; // the merged parts of the pilot, for batches after it
    bool list = false;
    std::uint64_t verify = 0; // batches per golden; 0: make goldens instead
    bool quiet = false;
    /// Which of the options above were given. --list and --verify compare only these with the golden.
    struct Given {
        bool size = false, samples = false, batch_size = false, pilot_batches = false, max_edges = false;
    } given;
};

/// Adds the options to `command`, which sets `options` when it is parsed, all but `given`.
void add_golden_options(CLI::App& command, GoldenCommand& options);

/// Throws std::invalid_argument for samples that are not whole batches, or that leave none after the
/// pilot.
void check(const GoldenCommand& options);

/// Adds the subcommand to `program`.
void add_golden_command(CLI::App& program, Work& work);

} // namespace cli
