#pragma once

namespace cli {

/// Makes Ctrl-C (SIGINT) and SIGTERM ask for an orderly end; a second one ends the program at once.
void catch_interrupts();

/// Whether an orderly end has been asked for. May be called from any thread.
bool interrupt_requested();

} // namespace cli
