#pragma once

// Reports of trees and of builders, for people and for machines.

#include "check/trees/check_builder.h"
#include "check/trees/check_tree.h"

#include <string>

namespace check {

/// Several lines: every property with its verdict, the first counter-example of each that fails, depth,
/// and costs.
std::string describe(const TreeReport& report);
/// Several lines: every kind of input with what became of it, then the smallest input that fails.
std::string describe(const BuilderReport& report);

/// The same as one JSON object each, in one line (docs/own-code.md names the fields).
std::string json(const TreeReport& report);
std::string json(const BuilderReport& report);

} // namespace check
