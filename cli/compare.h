#pragma once

// The subcommand `compare`; see command.h.

#include "cli/command.h"

namespace cli {

void add_compare_command(CLI::App& program, Work& work);

} // namespace cli
