#pragma once

// Whether what was printed has arrived: a pipe may be closed and a disk full.

namespace cli {

/// Makes a closed pipe an error of the write, to be told as one, and not the end of the process. Call it
/// before anything is printed.
void expect_closed_pipes();

/// Hands over what was printed to std::cout and stdout. Whether all of it has arrived so far.
bool flush_standard_output();

} // namespace cli
