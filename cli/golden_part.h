#pragma once

#include "cli/golden_command.h"

namespace cli {

/// Makes a part of one golden, or goes on with it: the batches of --batches. Throws
/// std::invalid_argument for options that do not suit each other, images::ImageError for a file that is
/// another part or not the golden's pilot, and the errors of the renderer.
ExitStatus make_golden_part(const GoldenCommand& options);

} // namespace cli
