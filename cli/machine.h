#pragma once

// Where, when and how results were made, for their head.

#include "cli/processor.h"

#include <string>

namespace CLI {
class App;
}

namespace cli {

/// The command line of `command`, a subcommand that was parsed: its name and the options that were
/// given.
std::string command_line(const CLI::App& command);

} // namespace cli
