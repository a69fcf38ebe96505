#pragma once

// The subcommand `compare`: its options, and the function that adds it (see command.h).

#include "cli/command.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace cli {

struct CompareCommand {
    std::vector<std::string> pictures; // candidates, then the golden
    std::optional<double> samples;     // per pixel, of a single picture or of a scene's first stage
    std::string layer;                 // of .exr files; empty: their R, G and B
    std::string scene;                 // the golden's, to find mistakes of light transport
    std::string integrator;            // of a scene; empty: the golden's
    std::string device = "ref";        // that renders a scene
    std::optional<std::uint64_t> seed; // of a scene; none: another one every time
    unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    std::string report; // file to write; empty: none
    bool json = false;
    bool quiet = false;
};

/// Adds the options to `command`, which sets `options` when it is parsed.
void add_compare_options(CLI::App& command, CompareCommand& options);

/// Adds the subcommand to `program`.
void add_compare_command(CLI::App& program, Work& work);

} // namespace cli
