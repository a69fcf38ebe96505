#pragma once

// The pattern of a subcommand: a function that adds it to the program, with its options and the work to
// do when it is chosen. The work returns the exit status, or throws what is wrong.

#include <CLI/CLI.hpp>

#include <functional>

namespace cli {

enum ExitStatus {
    fine = 0,
    check_failed = 1, // a comparison or a check said no
    bad_input = 2,    // wrong usage, unreadable file, unwritable file
    inconclusive = 3, // a comparison could not tell
    interrupted = 130 // by Ctrl-C or SIGTERM, after what was done was kept; as shells say it
};

/// What the chosen subcommand does.
using Work = std::function<ExitStatus()>;

/// Each adds its subcommand to `program` and, when it is chosen, sets `work`.
void add_render_command(CLI::App& program, Work& work);

} // namespace cli
