#pragma once

// Where and when results were made, for their head.

#include <string>

namespace CLI {
class App;
}

namespace cli {

/// "2026-11-27", in local time.
std::string today();

/// The name of the processor, or "unknown processor".
std::string processor_name();

/// The command line of `command`, a subcommand that was parsed: its name and the options that were
/// given.
std::string command_line(const CLI::App& command);

} // namespace cli
