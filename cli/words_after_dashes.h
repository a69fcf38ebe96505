#pragma once

// The command of somebody else's program, at the end of ours: plumbline check-renderer OPTIONS --
// COMMAND. CLI11 must not read it: it would change words such as [a,b], and report a wrong option of
// ours as one of theirs.

#include <string>
#include <vector>

namespace cli {

/// Cuts "--" and all words after it off the command line of the subcommand `name`, and keeps the words.
/// Another subcommand's command line stays as it is.
void take_words_after_dashes(int& argc, char** argv, const std::string& name);

/// The words that were kept; empty if there were none.
const std::vector<std::string>& words_after_dashes();

} // namespace cli
