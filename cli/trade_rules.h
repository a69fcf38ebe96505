#pragma once

// What each knob of `plumbline trade` turns, and by which values.

#include "cli/trade_settings.h"

#include <span>
#include <string>
#include <vector>

namespace cli {

using Values = std::vector<std::string>;

/// A knob. Its values are those of one option of `plumbline render`, except of `roulette`, which may be
/// off, and of `ref-tree`, whose values contain the size of leaves.
struct KnobRule {
    const char* name;
    const char* what;          // one line
    bool usual;                // turned if none is named
    const char* default_value; // of an option that is not set
    Settings home;             // settings without which it has no effect
    Values (*values)(const Settings& reference);
};

std::span<const KnobRule> all_knob_rules();

/// The knob of that name. Throws std::invalid_argument, naming the option of the command line, if there
/// is none.
const KnobRule& rule_of(const std::string& name, const std::string& option = "--knobs");

/// `settings` with this value of the knob, without settings that have no effect beside it.
Settings turn(Settings settings, const KnobRule& rule, const std::string& value);

/// The value of the knob in `settings`.
std::string value_of(const Settings& settings, const KnobRule& rule);

} // namespace cli
