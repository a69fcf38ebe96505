#pragma once

// `plumbline golden --verify` and `--list`.

#include "cli/golden_command.h"

namespace cli {

/// Renders batches of each golden anew, drawn at random, and compares all their functionals, bit for
/// bit; with as many batches as the golden has, its mean too. Says what it finds line by line.
ExitStatus verify_goldens(const GoldenCommand& options);

/// A line per scene: what its golden holds, what error a comparison with it can see, and whether the
/// scene has changed since.
ExitStatus list_goldens(const GoldenCommand& options);

} // namespace cli
