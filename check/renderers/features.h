#pragma once

// What a scene asks of a renderer, as words: for the choice of scenes, and for what failures have in
// common.

#include "scenes/requirements.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace check {

/// A feature of scenes/requirements.h. `name` is a word for a command line: "spot"; `phrase` follows
/// "scenes with": "a spot light".
struct Feature {
    std::string_view name;
    std::string_view phrase;
};

/// All features, in the order of scenes/requirements.h.
std::vector<Feature> all_features();

/// The names of the features that a scene uses.
std::set<std::string> feature_names(const scenes::Requirements& required);

} // namespace check
