#pragma once

// The day and the processor, for the head of results.

#include <string>

namespace cli {

/// "2026-11-27", in local time.
std::string today();

/// The name of the processor, or "unknown processor".
std::string processor_name();

} // namespace cli
