#pragma once

// Interruption by Ctrl-C or SIGTERM.

namespace cli {

/// From now on Ctrl-C (SIGINT) and SIGTERM request an orderly end. A second one kills the programs that
/// this one has started (check/child_program.h), removes its temporary folders, and then ends it at
/// once, after five seconds in any case. To be called once.
void catch_interrupts();

/// Whether an orderly end was requested. May be called from any thread.
bool interrupt_requested();

/// Thrown by work that was interrupted before there was anything to keep.
struct Interrupted {};

} // namespace cli
