#pragma once

// `plumbline golden --verify` and `--list`.

#include "cli/golden_command.h"

namespace cli {

/// Renders batches of each golden anew, drawn at random, and compares all their functionals, bit for
/// bit; with as many batches as the golden has, its mean too. Prints a line per golden.
ExitStatus verify_goldens(const GoldenCommand& options);

/// Prints a line per scene: size and samples of its golden, the error that a comparison with it detects,
/// and whether the scene has changed since.
ExitStatus list_goldens(const GoldenCommand& options);

} // namespace cli
