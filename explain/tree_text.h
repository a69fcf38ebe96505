#pragma once

// The explanation of a primitive in a tree, for a terminal and for programs.

#include "explain/tree.h"

#include <string>

namespace explain {

/// Several paragraphs of lines. `name`: of the scene.
std::string describe(const TreeExplanation& tree, const std::string& name);

/// One JSON object; docs/explain.md describes its members.
std::string json(const TreeExplanation& tree, const std::string& name);

} // namespace explain
