#pragma once

// The subcommand `check-renderer`: its options, and the function that adds it (see command.h).

#include "cli/command.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct CheckRendererCommand {
    std::vector<std::string> command; // program and arguments, with placeholders
    std::string suite;                // folder; empty: the current one, or that of this program
    std::vector<std::string> scenes;  // names; empty: all
    std::vector<std::string> without; // features or scenes
    bool list = false;
    std::uint64_t samples = 64;
    std::uint64_t seed = 1;
    std::string format = "exr";
    std::uint64_t pictures = 16;
    std::uint64_t most_pictures = 256;
    double error = 0.5;     // percent
    double budget = 1800.0; // seconds
    double timeout = 300.0; // seconds
    bool no_mistakes = false;
    std::string keep;   // folder
    std::string report; // .html
    bool json = false;
    bool quiet = false;
};

/// Adds the options to `command`, which sets `options` when it is parsed.
void add_check_renderer_options(CLI::App& command, CheckRendererCommand& options);

/// Throws std::invalid_argument or images::ImageError for options that exclude each other, a command
/// without a placeholder that it needs, and files that cannot be written.
void check(const CheckRendererCommand& options);

/// Adds the subcommand to `program`.
void add_check_renderer_command(CLI::App& program, Work& work);

} // namespace cli
