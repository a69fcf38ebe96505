#pragma once

// Errors of standard output, such as a closed pipe or a full disk.

namespace cli {

/// From now on a closed pipe is an error of the write and does not end the process. Call it before
/// anything is printed.
void expect_closed_pipes();

/// Flushes std::cout and stdout. Returns whether everything so far was written.
bool flush_standard_output();

} // namespace cli
