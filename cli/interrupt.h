#pragma once

// Ctrl-C.

namespace cli {

/// Makes Ctrl-C (SIGINT) and SIGTERM ask for an orderly end; a second one ends the program at once.
void catch_interrupts();

/// Whether an orderly end has been asked for. May be called from any thread.
bool interrupt_requested();

/// Thrown by work that was interrupted before there was anything to keep.
struct Interrupted {};

} // namespace cli
