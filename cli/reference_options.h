#pragma once

// Those options of `plumbline render` that only the reference has: its tree, and experiments.

#include "cli/render_command.h"

namespace cli {

/// Adds them to `command`, which sets `options` when it is parsed.
void add_reference_options(CLI::App& command, RenderCommand& options);

/// Of these, the experiments: all but the tree's.
void add_experiment_options(CLI::App& command, RenderCommand& options);

/// The families of strategies that contribute: all but those of --without.
images::Families families_of(const RenderCommand& options);

/// Throws std::invalid_argument unless the integrator has the families of --without, and others.
void check_reference_options(const RenderCommand& options);

} // namespace cli
