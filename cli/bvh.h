#pragma once

// The subcommand `bvh`; see command.h.

#include "cli/command.h"

namespace cli {

void add_bvh_command(CLI::App& program, Work& work);

} // namespace cli
