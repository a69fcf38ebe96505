#pragma once

// The pattern of a subcommand X. X_command.h declares its options, a struct, and add_X_command, which
// adds it to the program and, when it is chosen, sets the work to do. The work returns the exit status,
// or throws an exception. X_options.cpp reads the options, X_command.cpp does the work, and its parts
// are named after it: X_report.h, for example.

#include <functional>

namespace CLI {
class App; // only declared: CLI11 takes long to compile
}

namespace cli {

enum ExitStatus {
    fine = 0,
    check_failed = 1, // a comparison or a check failed
    bad_input = 2,    // wrong usage, unreadable file, unwritable file
    inconclusive = 3, // a comparison has no verdict
    interrupted = 130 // by Ctrl-C or SIGTERM, as shells report it; finished work was kept
};

/// The work of the chosen subcommand.
using Work = std::function<ExitStatus()>;

} // namespace cli
