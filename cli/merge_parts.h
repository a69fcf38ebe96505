#pragma once

#include "cli/merge_command.h"

namespace cli {

/// Joins the parts and writes the whole. Throws images::ImageError for parts that do not make a whole
/// (see images/parts.h) and for files that cannot be read or written, std::invalid_argument for options
/// that do not suit the parts.
ExitStatus merge_parts(const MergeCommand& options);

} // namespace cli
