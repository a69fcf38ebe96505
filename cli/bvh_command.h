#pragma once

// The subcommand `bvh`: its options, and the function that adds it (see command.h).

#include "cli/command.h"

#include <string>

namespace cli {

struct BvhCommand {
    std::string scene;
    std::string builder;
    std::string picture;
    std::string show = "boxes";
    std::string figure;
    int level = 4;
    int repeats = 5;
    std::string device;
    unsigned threads = 1;
    std::string size = "240x160";
    bool frame = false;
    bool json = false;
    bool quiet = false;
};

/// Adds the options to `command`, which sets `options` when it is parsed.
void add_bvh_options(CLI::App& command, BvhCommand& options);

/// Whether the builders of the reference are measured, with rays: not if only a picture or a figure is
/// asked for, nor with --device.
bool measures_builders(const BvhCommand& options);

/// Adds the subcommand to `program`.
void add_bvh_command(CLI::App& program, Work& work);

} // namespace cli
