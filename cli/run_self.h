#pragma once

// Runs this program once more, in a process of its own.

#include <optional>
#include <string>
#include <vector>

namespace cli {

/// The standard output of `plumbline ARGUMENTS...`, whose standard error is dropped. None if it cannot
/// be started or fails.
std::optional<std::string> output_of_self(const std::vector<std::string>& arguments);

} // namespace cli
