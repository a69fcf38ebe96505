#pragma once

// The knobs of `plumbline trade`: which options of `plumbline render` are varied, by which values, and
// what they are compared with.

#include "cli/trade_settings.h"
#include "trade/study.h"

#include <string>
#include <vector>

namespace cli {

/// Configurations and the knobs that they belong to. Configuration 0 is the base. The names say what
/// differs from the base.
struct TradePlan {
    std::vector<Settings> settings;
    std::vector<std::string> names;
    std::vector<trade::Knob> knobs;
};

/// All knobs with their usual values and an explanation, one line each; a star marks the usual knobs.
std::string describe_knobs();

/// The base for settings such as "integrator=bdpt": one thread of the fast path on the host, path
/// tracing, unless they say otherwise. Throws std::invalid_argument for a text that is no setting.
Settings base_of(const std::vector<std::string>& settings);

/// The plan for knobs such as "threads" or "max-edges=2,4"; "all" are all, none are the usual ones.
/// Where a knob does not apply to the base, it is turned on a reference of its own: on the reference
/// renderer (device=ref), for example. `max_edges`: of the truth; the longest that is measured.
/// Throws std::invalid_argument for names that are not known and for empty lists.
TradePlan plan_of(const Settings& base, const std::vector<std::string>& knobs, int max_edges);

} // namespace cli
