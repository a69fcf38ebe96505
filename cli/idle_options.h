#pragma once

// Options of `plumbline render` and `plumbline bvh` that were given and have no effect.

#include "cli/bvh_command.h"
#include "cli/render_command.h"

namespace cli {

/// Throws std::invalid_argument for an option that was given on the command line of `command` and has no
/// effect beside the others in `options`: the message names both. An option whose effect holds
/// anyway (--deterministic with --device ref) is no error. `command` need not have all options.
void expect_no_idle_options(const CLI::App& command, const RenderCommand& options);
void expect_no_idle_options(const CLI::App& command, const BvhCommand& options);

} // namespace cli
